// SPDX-License-Identifier: GPL-3.0-or-later
// What is written on the backs of pieces instead of their fronts.
#pragma once

#include <vector>

#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::export_ {

/// Takes numbers, names and their leaders off the fronts of a page's pieces, but for what stands on tabs, and
/// gives them as they are seen on the back of the sheet when it is turned over: each at the same place of the
/// paper, and to be read from there.
[[nodiscard]] std::vector<Group> take_to_back(std::vector<PieceDrawing>& pieces, Vec2 sheet,
                                              TurnedOver turned_over);

}  // namespace ridgecraft::export_
