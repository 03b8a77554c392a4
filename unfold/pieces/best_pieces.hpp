// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the pieces of a surface, body by body.
#pragma once

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// The best forest that the search (energy/forest_search.hpp) comes to from `folds`, whose trees must be
/// allowed: each body by itself, bodies that are mirror images of each other together. `mirrored`:
/// of each edge, or empty. Independent of the number of threads. Throws Error(interrupted).
[[nodiscard]] Folds best_pieces(const NetProblem& problem, const Folds& folds,
                                const IdVector<EdgeId, EdgeId>& mirrored, const Context& context);

}  // namespace ridgecraft::unfold
