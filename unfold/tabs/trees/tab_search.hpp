// SPDX-License-Identifier: GPL-3.0-or-later
// The second phase: a clean net is changed, without a new overlap, until more of its cuts have room for a
// tab.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

struct TabSearch {
  double tolerance = 0.0;    ///< of overlap, mm, where a net is made for the search
  std::uint64_t trials = 0;  ///< swaps that are tried
  /// Asked of every tree that is about to be gone on from, if given: may it be (does it fit the sheet)?
  std::function<bool(const Folds&)> allowed;
  /// Asked of every tree that would be the best so far, if given: what takes too long to be asked of all.
  std::function<bool(const Folds&)> best_allowed;
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
[[nodiscard]] TabSearchResult search_tabs(const mesh::Surface& surface, const prepare::Panels& panels,
                                          const Patch& patch, const Folds& folds, const TabOptions& options,
                                          const TabSearch& search, std::uint64_t seed,
                                          const Context& context);

/// The same for a net that counts tabs: it is at the best tree afterwards.
TabSearchResult search_tabs(ChangingNet& net, const TabSearch& search, std::uint64_t seed,
                            const Context& context);

/// The same, but the net keeps its tree where the other has no more tabs or isn't clean when it is laid out
/// afresh. About 0.5 ms per face with 10 trials per face.
void improve_tabs(ChangingNet& net, const TabSearch& search, std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
