// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that need no number: whoever closes a wedge of the paper finds them beside each other.
#pragma once

#include "export/page/piece_drawing.hpp"

namespace ridgecraft::export_ {

/// Whether this number can be left out once the other edge with it has it: on the same outline, no border
/// between them, and nothing else than pairs of edges that close in the same way, as a zip does from its end.
/// `at`: a place in `rim`, which is one of the piece's. O(the rim).
[[nodiscard]] bool closes_by_itself(const PieceDrawing& piece, const std::vector<std::size_t>& rim,
                                    std::size_t at);

/// Of the numbers that have no place, those that need none (NumberAt::closing): their other edge has it and
/// closes_by_itself(). O(square of a rim).
void leave_out_closing(PieceDrawing& piece);

}  // namespace ridgecraft::export_
