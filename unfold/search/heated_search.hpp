// SPDX-License-Identifier: GPL-3.0-or-later
// A second search for a tree without overlap, for bodies on which tabu search stays a few pairs away from
// one.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

struct HeatedSearch {
  double tolerance = 0.0;    ///< mm
  std::uint64_t trials = 0;  ///< swaps that are looked at, at most: about half a million a second
};

/// Swaps that are worth looking at for a patch: spiky bodies need 500 for each face.
[[nodiscard]] std::uint64_t heated_trials(std::uint32_t faces);

struct HeatedFound {
  Folds folds;                 ///< the best tree
  std::uint64_t overlaps = 0;  ///< of it; 0: laid out afresh and checked
  std::uint64_t trials = 0;
};

/// Simulated annealing from the tree `from` of a connected patch. Each trial draws a pair that overlaps, a
/// fold on the path between its faces and a cut that could take its place, and makes the swap where it adds
/// few pairs enough for the heat (N. Metropolis et al., 1953; focused on what is wrong: S. Seitz, M. Alava,
/// P. Orponen, 2005). Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] HeatedFound heated_search(const Patch& patch, const Folds& from, const HeatedSearch& options,
                                        std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
