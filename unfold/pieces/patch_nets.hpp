// SPDX-License-Identifier: GPL-3.0-or-later
// Why a patch became more than one piece: what is blamed is what would save the piece if it weren't so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "base/random.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/page_split.hpp"

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

// All that is done with one connected patch: its nets, clean and of a size to fit the sheet.

struct PatchNets {
  Folds folds;  ///< a forest: each tree one piece without overlap
  std::vector<PieceReason>
      reason;                  ///< per piece in the order of lay_out: why it isn't one with its neighbours
  std::vector<Message> notes;  ///< sentences about what didn't go the usual way; "it" is the patch
};

/// How long a net is searched for.
enum class Effort {
  full,   ///< until the context's deadline
  brief,  ///< only what comes first is taken, by choice and not for want of time: nothing is told of the time
};

/// One net where one exists and fits, else as few pieces as possible: (1) single nets from several start
/// trees, panels whole; (2) if there is none and panels may be cut, with cuts inside panels; (3) if there is
/// none, the best tree cut at its conflicts and joined again where possible; (4) pieces that don't fit the
/// room are split, taken apart and joined anew, and neighbours unfolded afresh together as long as that gives
/// fewer. The best of several attempts is kept. Every panel of the patch must fit the room by itself.
[[nodiscard]] PatchNets unfold_patch(const Patch& patch, const Room& room, PanelCuts cuts, double tolerance,
                                     std::uint64_t seed, Effort effort, const Context& context);

}  // namespace ridgecraft::unfold
