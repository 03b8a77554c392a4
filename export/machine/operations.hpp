// SPDX-License-Identifier: GPL-3.0-or-later
// What a machine does on a page, in order: nothing but lines, each once, none too short to be meant.
#pragma once

#include <string_view>
#include <vector>

#include "export/machine/bridges.hpp"
#include "export/machine/scores.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

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

/// What a machine can do, and wants to be told.
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

}  // namespace ridgecraft::export_
