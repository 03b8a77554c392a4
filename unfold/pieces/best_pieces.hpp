// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the pieces of a surface, body by body.
#pragma once

#include <span>

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {

/// The best forest that the search (energy/forest_search.hpp) comes to from `folds`, whose trees must be
/// allowed: each body by itself, bodies that are images of each other together. Independent of the
/// number of threads. Throws Error(interrupted).
[[nodiscard]] Folds best_pieces(const NetProblem& problem, const Folds& folds,
                                std::span<const EdgeImages> images, const Context& context);

}  // namespace ridgecraft::unfold
