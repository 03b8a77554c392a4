// SPDX-License-Identifier: GPL-3.0-or-later
// Where pieces may be split so that every edge that is wide enough has a tab: as few pieces more as can be
// found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"

namespace ridgecraft::unfold {

/// The nets of a forest with all their tabs, as they will be returned.
using NetsOf = std::function<Nets(const Folds&)>;

// Which folds to cut so that tabs get room: those that lie between many tabs and what stands in their way.

/// A forest of the whole surface's patch that lacks tabs.
struct ForestWithGaps {
  const mesh::Surface& surface;
  const Patch& patch;
  const Folds& folds;
  const TabGaps& tab_gaps;
  std::span<const TabGap> gaps;
};

/// Chooses folds, one side of each, until each gap has a place from which all that stands in its way is cut
/// off, as far as cutting can do that: the fold that does most for all gaps first (greedy set cover, V.
/// Chvatal 1979, over tree paths). What the tabs of the new cuts need isn't foreseen. O(cuts (gaps + folds on
/// their paths)). Throws Error(interrupted).
[[nodiscard]] std::vector<std::uint32_t> choose_tab_cuts(const ForestWithGaps& forest,
                                                         const Context& context);

/// Cuts pieces of a clean forest until every join that can (TabGaps::able) has a usable tab. Single flat
/// regions stay whole, all pieces fit the room. Every tab that is counted was placed by place_tabs. Ends at
/// the deadline with what it has.
[[nodiscard]] Folds split_for_tabs(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of,
                                   const Context& context);

}  // namespace ridgecraft::unfold
