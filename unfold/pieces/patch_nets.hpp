// SPDX-License-Identifier: GPL-3.0-or-later
// All that is done with one connected patch: its nets, clean and of a size to fit the sheet.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/page_split.hpp"

namespace ridgecraft::unfold {

struct PatchNets {
  Folds folds;  ///< a forest: each tree one piece without overlap
  std::vector<PieceReason>
      reason;  ///< per piece in the order of lay_out: why it isn't one with its neighbours
  std::vector<std::string> notes;  ///< sentences about what didn't go the usual way; "it" is the patch
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
