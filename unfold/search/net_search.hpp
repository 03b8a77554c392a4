// SPDX-License-Identifier: GPL-3.0-or-later
// One net of one patch: start trees, searches, restarts, within a budget that is counted in iterations.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/start_tree.hpp"

namespace ridgecraft::unfold {

struct NetSearch {
  StartTree start = StartTree::short_cuts;  ///< later starts: the other kinds in turn
  double tolerance = 0.0;                   ///< mm
  int starts = 3;                           ///< start trees, at least 1: searched in turns
  std::uint64_t iterations = 0;             ///< of all starts together
  std::uint64_t idle = 0;  ///< a start ends after so many without a better tree; 0: idle_iterations
};

/// Iterations without a better tree after which a start is given up: enough that no good tree is thrown away.
[[nodiscard]] std::uint64_t idle_iterations(std::uint32_t faces);
/// A budget that solves every net of our measurements that is solved at all, but ends.
[[nodiscard]] std::uint64_t iteration_budget(std::uint32_t faces);

struct NetFound {
  Folds folds;                 ///< the best tree
  std::uint64_t overlaps = 0;  ///< of it; 0: a clean net, laid out afresh and checked
  std::uint64_t iterations = 0;
  int starts = 0;
  bool hopeless = false;  ///< what is left is far from a net: other starts won't find any either
};

/// Searches a connected patch for a tree without overlap. Deterministic for one seed but for the deadline,
/// with any number of threads.
[[nodiscard]] NetFound find_net(const Patch& patch, const NetSearch& options, std::uint64_t seed,
                                const Context& context);

}  // namespace ridgecraft::unfold
