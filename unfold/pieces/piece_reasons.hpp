// SPDX-License-Identifier: GPL-3.0-or-later
// Why a patch became more than one piece: what is blamed is what would save the piece if it weren't so.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// How many pieces a patch would be, the fewest known: without any limit of size, and with that of flat
/// regions in a piece alone.
struct PiecesWithout {
  std::size_t limits = 1;
  std::size_t paper = 1;
  PieceReason overlap = PieceReason::overlap;  ///< why it is more than one without limits
};

/// `clean`: a forest without overlap that needn't fit. The fewest pieces that it makes where the paper is as
/// large as one likes.
[[nodiscard]] std::size_t pieces_without_paper(const Patch& patch, const Folds& clean, const Room& room,
                                               double tolerance, Random random, const Context& context);

/// Per piece in the order of lay_out: the largest stands for the patch, as many of the next ones as it would
/// have all the same are there for overlap or the number of their flat regions, and all others for the page.
[[nodiscard]] std::vector<PieceReason> piece_reasons(const Patch& patch, const Folds& folds,
                                                     const PiecesWithout& without);

}  // namespace ridgecraft::unfold
