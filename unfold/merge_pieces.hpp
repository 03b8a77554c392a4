// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that can lie together become one.
#pragma once

#include "mesh/context.hpp"
#include "unfold/page_split.hpp"
#include "unfold/patch.hpp"

namespace ridgecraft::unfold {

/// Folds cuts between two pieces wherever the joined piece has no overlap deeper than the tolerance (mm) and
/// fits the room, longest cuts first, until no more can be joined. Stops after `pair_budget` pairs of faces
/// were compared.
[[nodiscard]] Folds merge_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                 std::uint64_t pair_budget, const Context& context);

}  // namespace ridgecraft::unfold
