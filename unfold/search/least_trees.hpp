// SPDX-License-Identifier: GPL-3.0-or-later
// How many nets a patch of any size needs at least: what flat regions with holes leave apart is counted
// without looking at all forests.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

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
