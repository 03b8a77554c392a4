// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbouring pieces are unfolded afresh together, to have fewer of them.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// Looks for two neighbouring pieces whose faces have one net that fits the room, small ones first, and
/// replaces them by it, until there are none or the budget is spent. Panels stay whole; nothing overlaps
/// deeper than `tolerance` (mm) that didn't before.
[[nodiscard]] Folds unite_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                 std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
