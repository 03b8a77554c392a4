// SPDX-License-Identifier: GPL-3.0-or-later
// Where a piece's name stands.
#pragma once

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"

namespace ridgecraft::export_ {

/// Puts the name where it has the most room: inside the piece, as large as it can be, on the point of a grid
/// around which the largest box is free (a pole of inaccessibility for the shape of the text). A piece too
/// full for that gets its name beside it with a leader; false if there is no room for that either. `hurried`:
/// inside and parallel to the page or nowhere.
[[nodiscard]] bool place_name(PieceDrawing& piece, Obstacles& obstacles, const Box2& area,
                              bool hurried = false);

}  // namespace ridgecraft::export_
