// SPDX-License-Identifier: GPL-3.0-or-later
// When it is settled which faces make a piece, its tree is chosen once more, so that it folds freely.
#pragma once

#include <span>

#include "base/context.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {

/// Changes the tree of each piece of a clean forest so that it doesn't run through itself while all creases
/// are folded together (folding/folding_meetings.hpp), where that costs little (energy/forest_energy.hpp), or
/// whatever it costs where that is the rule: then a piece is split, too, as far as edges that are to be kept
/// allow. The pieces stay free of overlap and fit the room if they did; of two that are images of each other
/// the second gets what the first got. The patch is the whole surface. Deterministic for one seed but for the
/// deadline; one piece is one task.
[[nodiscard]] Folds foldable_trees(const NetProblem& problem, const Folds& folds,
                                   std::span<const EdgeImages> images, const Context& context);

}  // namespace ridgecraft::unfold
