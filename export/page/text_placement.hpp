// SPDX-License-Identifier: GPL-3.0-or-later
// Where the numbers and names of a page's pieces stand.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

/// Adds its texts to each piece of one page: each join's number inside the piece at its edge and on its tab,
/// and the piece's name in the widest free place. No text covers a line or another text, or reaches out of
/// piece_box(). Each number takes the first place that has room: at its edge, further inside, with a leader
/// inside, with a leader beside the piece. Without one it stands in a list, as its seam says (Seam::at). Past
/// the context's deadline and grace only places at the edge are tried. O(numbers x places x lines near them).
void place_texts(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
                 DrawReport& report, const Context& context);

}  // namespace ridgecraft::export_
