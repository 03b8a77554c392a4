// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that can lie together become one.
#pragma once

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// Folds cuts between two pieces wherever the joined piece has no overlap deeper than the tolerance (mm) and
/// fits the room, cuts in panels and long cuts first, until no more can be joined. Stops after `pair_budget`
/// pairs of faces were compared. With `random` the order is blurred, so that another call may end otherwise.
[[nodiscard]] Folds merge_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                 std::uint64_t pair_budget, const Context& context, Random* random = nullptr);

}  // namespace ridgecraft::unfold
