// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that are printed and then cut: marks that the cutter looks for, at the same places in both files.
#pragma once

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

}  // namespace ridgecraft::export_
