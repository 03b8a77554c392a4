// SPDX-License-Identifier: GPL-3.0-or-later
// How a piece tells what of it is rolled: short ticks at the ends of a few bends, which have no line, and
// words with an arrow along the way in which the paper goes round.
#pragma once

#include <span>

#include "export/page/obstacles.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/rolled.hpp"

namespace ridgecraft::export_ {

/// Adds ticks to the drawing at both ends of the first, the middle and the last bend of each part, and the
/// places where its words may stand. `parts`: those of this piece.
void add_roll_marks(const PieceOnPage& at, std::span<const RolledPart> parts, PieceDrawing& piece);

/// Adds the words of each roll with an arrow on either side, where the piece has room for them; a guide tells
/// it anyway. O(places x lines near them).
void place_roll_words(PieceDrawing& piece, Obstacles& obstacles);

}  // namespace ridgecraft::export_
