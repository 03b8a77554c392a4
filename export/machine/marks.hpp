// SPDX-License-Identifier: GPL-3.0-or-later
// What is added to pages for a machine: marks that a cutter looks for on a printed sheet, at the same places
// in both files, and a small piece by which the kerf of a beam is measured.
#pragma once

#include <vector>

#include "export/sheet/drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// Keeps pieces out of the corners where the marks are: 10 mm from the sheet's edges, and 20 mm more at its
/// head and foot.
void fit_registration(Paper& paper);

/// The three marks that Silhouette's and Graphtec's cutters look for (the measures are those of inkscape-
/// silhouette's render_silhouette_regmarks): a filled square of 5 mm, its corner 10 mm from the top left
/// corner of the sheet, and angles with arms of 20 mm, 0.3 mm wide, at the same distance from the top right
/// and the bottom left corner, their arms along the edges. A group of id `registration_group`.
[[nodiscard]] Group registration_marks(Vec2 sheet);

/// What is printed of a page that is cut by a machine: colours, pictures, numbers, names, lists
/// and the marks; no line that is cut or folded, as the machine may be half a millimetre off. Without
/// marks where nothing is cut, on pages that have nothing but lists.
[[nodiscard]] Drawing printed_page(const Drawing& page);

/// Sides of the test piece and of the hole in it, mm. Cut with the right kerf they measure just that; with
/// none the piece is a kerf too small and the hole a kerf too large.
inline constexpr double kerf_test_mm = 20.0;
inline constexpr double kerf_test_hole_mm = 10.0;

/// Puts the test piece on the first page that has room for it beside its pieces, else on a page of its own at
/// the end. O(places of a grid of 4 mm * sides of the pages).
void add_kerf_test(std::vector<Drawing>& pages, const Paper& paper);

}  // namespace ridgecraft::export_
