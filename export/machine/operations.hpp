// SPDX-License-Identifier: GPL-3.0-or-later
// What a machine does on a page, in order: nothing but lines, each once, none too short to be meant. Folds
// are cut in dashes or marked at their ends, outlines keep bridges, as the machine's rules say.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// What a machine does at a fold.
enum class Scores {
  solid,      ///< the whole line, scored or creased
  dashes,     ///< cut through in dashes of 2 mm, held by 1 mm of paper each; 5 and 2 mm in board
  perforate,  ///< 3 mm cut, 0.8 mm paper
  ends,       ///< nothing on the piece, but lines of 4 mm beside it that show where the fold begins and ends
  none,
};

/// Lengths in mm.
struct ScorePattern {
  double cut = 2.0;
  double bridge = 1.0;
};

/// The pattern of Scores that have one; board is thicker than 1 mm.
[[nodiscard]] ScorePattern pattern_of(Scores scores, bool board);

/// The dashes along a line, each as a line. It begins and ends with a bridge, as a dash that meets an outline
/// or another fold begins a tear: no dash is nearer to an end than 0.8 bridges. The pattern is stretched to
/// fit, dashes by a quarter at most. Where a dash and two bridges have no room, there is one dash in the
/// middle with a bridge on either side, and none on lines shorter than three bridges. O(n).
[[nodiscard]] std::vector<std::vector<Vec2>> dashes_along(const std::vector<Vec2>& line,
                                                          const ScorePattern& pattern);

/// Where outlines stay uncut, so that pieces don't fall out of the sheet.
struct BridgeRules {
  int count = 0;          ///< of one outline; 0: it is cut all round
  double width_mm = 0.4;  ///< of each
};

/// In the order in which a sheet is worked: while it lies still and whole, what is written and folded; then
/// what falls out; outlines last.
enum class Operation {
  registration,  ///< marks that a machine looks for; nothing is done there
  engrave,       ///< numbers and names
  mountain,      ///< folds away from the printed side
  valley,        ///< folds towards it
  tab_fold,      ///< bases of tabs that go on flat; others are folds
  cut_inner,     ///< holes, and slits in a piece
  cut_outer,     ///< outlines of pieces
};
inline constexpr int operation_count = 7;

/// One way of a tool, mm, on the page.
struct Path {
  Operation operation = Operation::cut_outer;
  std::vector<Vec2> points;  ///< two or more; of a closed path three or more, the first one once
  bool closed = false;       ///< outlines, counterclockwise, and holes, clockwise
};

/// What a machine can do, and how.
struct PathRules {
  bool engraves = true;           ///< numbers and names are there
  Scores scores = Scores::solid;  ///< what is done at folds
  bool board = false;             ///< the sheet is thicker than 1 mm: dashes are longer
  double kerf_mm = 0.0;      ///< what the beam takes: outlines are moved outwards by half of it (kerf.hpp)
  BridgeRules bridges = {};  ///< of outlines
};

/// Marks by which a machine finds on a printed sheet what it is to cut: the lines of the group of this id.
inline constexpr std::string_view registration_group = "registration";

/// The pieces of a page as paths, by operation and then by piece; before them what the page has in its
/// registration group. What a printer draws around them (scale bar, legend, lists) isn't there, and neither
/// are the areas of tabs. Paths shorter than 0.2 mm are left out and points within 0.05 mm of the one before:
/// rounding makes them, where nets touch themselves, and a laser burns holes there. Names in letters that the
/// alphabet of lines doesn't have are left out. O(n log n); Scores::ends O(folds * sides).
[[nodiscard]] std::vector<Path> machine_paths(const Drawing& page, const PathRules& rules = {});

/// Lines of 45 degrees, so many mm apart, as far as they lie in a simple polygon; each by its ends. Lines of
/// all polygons of a page lie in one pattern. O(lines * corners).
[[nodiscard]] std::vector<std::array<Vec2, 2>> hatching(const std::vector<Vec2>& polygon, double apart_mm);

}  // namespace ridgecraft::export_
