// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of printed files share: layers by name, patterns by dashes, the words that pages carry;
// the operators of a PDF page's content (ISO 32000-1, sections 7.2, 7.8 and 8) and the paths of SVG as lines.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/vector.hpp"
#include "verify/file/file.hpp"
#include "verify/pages/printed.hpp"

namespace ridgecraft::verify {

/// Leaves a reader with the reason why the file can't be checked.
template <typename... Args>
[[noreturn]] void cannot_check(fmt::format_string<Args...> text, Args&&... args) {
  throw NotInForm{fmt::format(text, std::forward<Args>(args)...)};
}

/// The layer with this plain id ("tab-fold") or title ("Tab folds"); nothing if the format has no such layer.
[[nodiscard]] std::optional<PrintedLayer> layer_with_id(std::string_view id);
[[nodiscard]] std::optional<PrintedLayer> layer_with_title(std::string_view title);

/// Of which texts are kept, and whatever else it holds is none of the nets' lines.
[[nodiscard]] constexpr bool has_words(PrintedLayer layer) {
  return layer == PrintedLayer::label || layer == PrintedLayer::name;
}

/// Of which lines are kept; what else such a layer holds would be overlooked.
[[nodiscard]] constexpr bool is_checked(PrintedLayer layer) {
  return !has_words(layer) && layer != PrintedLayer::other;
}

/// Dash, gap, dash, gap ...
[[nodiscard]] Pattern pattern_of(std::span<const double> dashes);

/// The hexadecimal digits behind "ridgecraft-model:", or nothing.
[[nodiscard]] std::string digest_in(std::string_view text);

/// The name behind "preset:" among the words that a file bears, or nothing.
[[nodiscard]] std::string preset_in(std::string_view text);

/// What the text that a file tells its settings in says of the board that it was made for; 0 for paper.
[[nodiscard]] double thickness_in(std::string_view settings);

/// Takes back what pages were drawn larger or smaller for a printer (--calibrate): `settings` is the text
/// that the file tells its settings in; nothing changes where it says nothing of it.
void undo_calibration(std::string_view settings, PrintedFile& file);

/// Fills number and count from words that end in "page 2 of 3".
void read_page_words(std::string_view words, PrintedPage& page);

// The operators of a PDF page's content as lines (ISO 32000-1, sections 7.8 and 8). Knows bytes only; the
// caller knows the file around them.

/// (x, y) goes to (a x + c y + e, b x + d y + f).
struct Matrix {
  double a = 1.0, b = 0.0, c = 0.0, d = 1.0, e = 0.0, f = 0.0;

  [[nodiscard]] Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  /// By how much lengths grow, where they grow alike in all directions.
  [[nodiscard]] double scale() const;
};
/// First `inner`, then `outer`.
[[nodiscard]] Matrix product(const Matrix& inner, const Matrix& outer);

/// What holds until it is changed or taken back.
struct InkState {
  Matrix matrix;
  double width = 1.0;          ///< in the unit of the matrix's source
  std::vector<double> dashes;  ///< the same; empty: solid
  bool white = false;          ///< lines are drawn in the paper's colour
  bool hidden = false;         ///< lines are fully transparent
  std::optional<Box2> window;  ///< only what lies in here is drawn, in the unit of the matrix's target
};

/// A path that is painted.
struct InkPath {
  std::vector<std::vector<Vec2>>
      lines;            ///< subpaths with two points or more; closed ones end where they begin
  bool curved = false;  ///< some stretch isn't straight; `lines` has the ends of it
  bool stroked = false;
  bool filled = false;
};

/// One operand of Tj.
struct InkText {
  std::string codes;
  std::string_view font;
  double size = 0.0;
  Matrix place;  ///< of the text (Tm)
};

/// Who listens to what the content does.
struct ContentEvents {
  std::function<void(const InkPath&, const InkState&)> path;
  /// An object of the resources is drawn ("/cut Do": "cut").
  std::function<void(std::string_view name, const InkState&)> object;
  /// Whether a state of the resources hides lines ("/a0 gs"); none where it says nothing of that, which
  /// leaves them as they are. Never asked when empty.
  std::function<std::optional<bool>(std::string_view name)> hides_lines;
  /// A text is shown: its codes, the font ("/F Tf": "F"), its size, and where the baseline lies in the
  /// state's matrix. Whether it is seen doesn't matter.
  std::function<void(const InkText&, const InkState&)> text;
  /// Something else is painted that is no path, or text that is seen.
  std::function<void()> other;
};

/// Interprets the content, beginning with this state. Throws NotInForm where the bytes aren't what the
/// standard says, or where a part of the page is cut off by anything but a rectangle. O(size) and the points
/// of the paths.
void read_content(std::string_view bytes, const InkState& initial, const ContentEvents& events);

// The "d" of an SVG path as lines.

/// One list of points for each subpath, in the path's own unit; a closed one ends where it begins, one
/// without a line is left out. Straight lines only (M, L, H, V, Z, large or small): throws NotInForm for
/// others. O(size).
[[nodiscard]] std::vector<std::vector<Vec2>> path_lines(std::string_view data);

}  // namespace ridgecraft::verify
