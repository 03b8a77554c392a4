// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are so ragged that two would be easier to build become two.
#pragma once

#include <span>

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Cuts pieces at a fold where both sides together cost less than the one (piece_cost.hpp), as long as there
/// are such folds: mostly at necks, where little seam parts a long outline. The fold that saves most goes
/// first. The patch is the whole surface; `part`: of each of its faces. Folds in panels stay, and so
/// do pieces with a stretch of a wall that goes round (energy/bands.hpp).
/// O(n log n) for each cut of a piece of n faces. Deterministic.
[[nodiscard]] Folds with_ragged_pieces_cut(const Patch& patch, std::span<const PartId> part,
                                           const Folds& folds, const Weights& weights,
                                           const Context& context);

}  // namespace ridgecraft::unfold
