// SPDX-License-Identifier: GPL-3.0-or-later
// Where the names and numbers of a page's pieces stand.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

/// Puts the name where it has the most room: inside the piece, as large as it can be, on the point of a grid
/// around which the largest box is free (a pole of inaccessibility for the shape of the text). A piece too
/// full for that gets its name beside it with a leader; false if there is no room for that either. `hurried`:
/// inside and parallel to the page or nowhere.
[[nodiscard]] bool place_name(PieceDrawing& piece, Obstacles& obstacles, const Box2& area,
                              bool hurried = false);

/// Adds its texts to each piece of one page: the number of each row of edges (seam_marks.hpp), and the
/// piece's name in the widest free place. No text covers a line or another text, or reaches out of
/// piece_box(). Each number takes the first place that has room: on a tab, at its edge, further inside, with
/// a leader inside, with a leader beside the piece. A side of a chain that has its number nowhere stands in a
/// list, as its seams say (Seam::at). Past the context's deadline and grace only places on tabs and at the
/// edge are tried. O(numbers x places x lines near them).
void place_texts(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
                 DrawReport& report, const Context& context);

}  // namespace ridgecraft::export_
