// SPDX-License-Identifier: GPL-3.0-or-later
// The second phase: a clean net is changed, without a new overlap, until more of its cuts have room for a
// tab.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/foundation/context.hpp"
#include "mesh/panels.hpp"
#include "mesh/surface.hpp"
#include "unfold/search/patch.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {

struct TabSearch {
  double tolerance = 0.0;    ///< of overlap, mm
  std::uint64_t trials = 0;  ///< swaps that are tried
  /// Asked of every tree that is about to be gone on from, if given: may it be (does it fit the sheet)?
  std::function<bool(const Folds&)> allowed;
  /// Folds of the given tree that are cut for good, one side of each: the pieces that this makes of the patch
  /// are searched together (linked_patch.hpp).
  std::vector<std::uint32_t> links = {};
};

struct TabSearchResult {
  Folds folds;
  std::uint32_t cuts = 0;         ///< between faces of the patch, panels apart
  std::uint32_t tabs_before = 0;  ///< cuts with a usable tab in the tree that was given
  std::uint32_t tabs = 0;
  std::uint64_t trials = 0;
};

/// Improves a clean tree of a connected patch by simulated annealing: a cut becomes a fold, and a fold on the
/// tree path between its faces, from which a tab could grow, becomes a cut, if nothing overlaps then.
/// Deterministic for one seed but for the context's deadline. Throws Error(interrupted).
[[nodiscard]] TabSearchResult search_tabs(const mesh::Surface& surface, const mesh::Panels& panels,
                                          const Patch& patch, const Folds& folds, const TabOptions& options,
                                          const TabSearch& search, std::uint64_t seed,
                                          const Context& context);

}  // namespace ridgecraft::unfold
