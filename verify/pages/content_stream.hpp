// SPDX-License-Identifier: GPL-3.0-or-later
// The operators of a PDF page's content as lines (ISO 32000-1, sections 7.8 and 8). Knows bytes only; whoever
// calls it knows the file around them.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

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

/// Who listens to what the content does.
struct ContentEvents {
  std::function<void(const InkPath&, const InkState&)> path;
  /// An object of the resources is drawn ("/cut Do": "cut").
  std::function<void(std::string_view name, const InkState&)> object;
  /// Whether a state of the resources hides lines ("/a0 gs"); none where it says nothing of that, which
  /// leaves them as they are. Never asked when empty.
  std::function<std::optional<bool>(std::string_view name)> hides_lines;
  /// Text is set, or something else painted that is no path.
  std::function<void()> other;
};

/// Interprets the content, beginning with this state. Throws NotInForm where the bytes aren't what the
/// standard says, or where a part of the page is cut off by anything but a rectangle. O(size) and the points
/// of the paths.
void read_content(std::string_view bytes, const InkState& initial, const ContentEvents& events);

}  // namespace ridgecraft::verify
