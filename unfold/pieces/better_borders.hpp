// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbouring pieces are searched together for nets of least energy: their trees, and the borders between
// them.
#pragma once

#include "base/context.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// How far a forest may be from the best: a search that begins hot leaves nothing of a good one.
enum class Start { anywhere, near };

/// Brings a clean forest to less energy (energy/anneal.hpp), groups of pieces that meet by groups. Pieces may
/// hand faces to each other; their number stays, they stay clean and fit the room if they did. `mirrored`:
/// mirror_images. The patch is the whole surface. Deterministic for one seed but for the deadline; one group
/// is one task.
[[nodiscard]] Folds better_borders(const NetProblem& problem, const Folds& folds,
                                   const IdVector<EdgeId, EdgeId>& mirrored, Start start,
                                   const Context& context);

}  // namespace ridgecraft::unfold
