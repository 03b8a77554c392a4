// SPDX-License-Identifier: GPL-3.0-or-later
// The least number of nets that a small patch can become, proven by looking at all forests.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

struct LeastForestSearch {
  double tolerance = 0.0;       ///< mm
  std::size_t most_pieces = 1;  ///< forests of more trees aren't looked for
  std::uint64_t work = 0;       ///< pairs of faces that are compared, at most: some fifty million a second
};

struct LeastForest {
  /// No forest of fewer trees is free of overlap: proven. At most most_pieces + 1.
  std::size_t at_least = 1;
  /// A forest of at_least trees without overlap; empty where the work was spent or most_pieces is too few.
  Folds folds;
  std::uint64_t work = 0;
  /// The work was enough: at_least is the least number, or more than most_pieces.
  bool finished = false;
};

/// Branch and bound over the cuts and folds of a connected patch whose panels stay whole. An edge that would
/// lay two faces onto each other is a cut from then on, because trees only grow; where the rest can't connect
/// few enough trees any more, the branch is left. Exponential in the number of panels: meant for 30 or fewer.
/// Deterministic but for the deadline. Throws Error(interrupted).
[[nodiscard]] LeastForest least_forest(const Patch& patch, const LeastForestSearch& options,
                                       const Context& context);

// How many nets a patch of any size needs at least: what flat regions with holes leave apart is counted
// without looking at all forests.

struct LeastTreesSearch {
  double tolerance = 0.0;       ///< mm
  std::size_t most_panels = 0;  ///< blocks of more panels count as one net
  std::uint64_t work = 0;       ///< pairs of faces that are compared in blocks, at most
};

/// Proven: no forest without overlap has fewer trees, panels whole. An edge over which its two panels overlap
/// at once is never a fold; what the others leave unconnected is in different trees. A panel through which
/// all ways between two sets of panels lead (the rim of a mug, with its inside standing in the hole) parts
/// the rest into blocks: the folds within one make a forest of its own, so each block adds the trees that it
/// needs beyond one (least_forest.hpp). O(n) beside that. The patch needn't be connected. Throws
/// Error(interrupted).
[[nodiscard]] std::size_t least_trees(const Patch& patch, const LeastTreesSearch& options,
                                      const Context& context);

}  // namespace ridgecraft::unfold
