// SPDX-License-Identifier: GPL-3.0-or-later
// Where the numbers and names of a page's pieces stand.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

/// Adds its texts to each piece of one page: each join's number inside the piece at its edge and on its tab,
/// and the piece's name in the widest free place. No text covers a line or another text, or reaches out of
/// `area`. A number that finds no room at its edge moves further in, then gets a leader, at last a place
/// beside the piece; then it is left out, which its seam tells (Seam::told). Past the context's deadline
/// and grace it is left out where it finds no room at its edge.
void place_texts(std::vector<PieceDrawing>& pieces, Vec2 page_size, const Box2& area, const Style& style,
                 DrawReport& report, const Context& context);

}  // namespace ridgecraft::paper
