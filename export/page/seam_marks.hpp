// SPDX-License-Identifier: GPL-3.0-or-later
// How the edges of a chain are told: which of them share a number, and the ticks by which two sides are laid
// against each other.
#pragma once

#include <cstddef>
#include <vector>

#include "export/page/piece_drawing.hpp"

namespace ridgecraft::export_ {

/// Edges of a chain, in a row, that one number stands for.
struct NumberedRow {
  std::size_t side = 0;            ///< of PieceDrawing::sides
  std::vector<std::size_t> seams;  ///< of PieceDrawing::seams; never empty
};

/// What numbers the piece needs: one between two sharp corners that aren't close together, and one for every
/// 40 mm or so, at different edges. Each seam is in one row. Linear.
[[nodiscard]] std::vector<NumberedRow> numbered_rows(const PieceDrawing& piece);

/// Adds the ticks: long ones where one chain goes on as another one and no sharp corner tells so, short ones
/// between the edges of a chain where neither a corner nor a fold shows where they meet, and at equal
/// distances along long edges. All begin on the outline and lie on the piece. O(corners x lines).
void add_ticks(PieceDrawing& piece);

}  // namespace ridgecraft::export_
