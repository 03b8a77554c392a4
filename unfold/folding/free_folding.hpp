// SPDX-License-Identifier: GPL-3.0-or-later
// A piece that runs through itself while it is folded gets another tree, if there is one near that doesn't.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// Whether the net of this tree folds up with all creases together without running through itself.
[[nodiscard]] bool folds_together(const Patch& piece, const Folds& tree, const Context& context);

/// What a net costs, in any unit; nothing where it isn't allowed, as where it doesn't fit the sheet.
using CostOfNet = std::function<std::optional<double>(ChangingNet&)>;

/// Gives a net that doesn't fold up with all creases together a tree that does, if one is found that costs no
/// more than the given one and `worth`: of several the cheapest of those with the shortest cuts. They are
/// found by walks from the given tree, on which folds between faces that meet on the way (or overlap) are
/// exchanged (folding_meetings.hpp). False where the net is as it was. About 0.02 s for a piece of 50 faces
/// that doesn't fold together. Deterministic for one seed but for the deadline.
bool fold_freely(ChangingNet& net, const CostOfNet& cost, double worth, std::uint64_t seed,
                 const Context& context);

}  // namespace ridgecraft::unfold
