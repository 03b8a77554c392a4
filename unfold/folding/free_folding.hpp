// SPDX-License-Identifier: GPL-3.0-or-later
// A piece that runs through itself while it is folded gets another tree, if there is one near that doesn't.
#pragma once

#include <cstdint>
#include <functional>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// Whether the net of this tree folds up in one of the ways of fold_order.hpp without running through itself.
[[nodiscard]] bool folds_freely(const Patch& piece, const Folds& tree, const Context& context);

/// Gives a net that doesn't fold up freely in one of the ways of fold_order.hpp a tree that does, found by
/// exchanging folds between faces that meet on the way, as long as no more of them do and `allowed` says yes.
/// False where the net is as it was. About 0.05 s for a piece of 100 faces that doesn't fold freely.
/// Deterministic for one seed but for the deadline.
bool fold_freely(ChangingNet& net, const std::function<bool(ChangingNet&)>& allowed, std::uint64_t seed,
                 const Context& context);

}  // namespace ridgecraft::unfold
