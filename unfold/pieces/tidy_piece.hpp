// SPDX-License-Identifier: GPL-3.0-or-later
// A piece with other folds and the same faces: shorter cuts, less waste, fewer thin branches.
#pragma once

#include <cstdint>
#include <functional>

#include "base/context.hpp"
#include "unfold/net/piece_rules.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// Exchanges folds of a clean net for cuts as long as that lowers its cost (objective.hpp), a tab more being
/// worth an edge to be glued, loses no tab, makes no overlap, and `allowed` says yes: trials in proportion to
/// its faces, about 0.03 ms each for a hundred of them. False where the net is as it was. Deterministic for
/// one seed but for the deadline.
bool tidy_piece(ChangingNet& net, const std::function<bool(ChangingNet&)>& allowed, const Weights& weights,
                std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
