// SPDX-License-Identifier: GPL-3.0-or-later
// Where pieces may be split so that every edge that is wide enough has a tab: as few pieces more as can be
// found.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/pieces/split_forest.hpp"

namespace ridgecraft::unfold {

/// Cuts pieces of a clean forest until every join that can (TabGaps::able) has a usable tab, and unites what
/// was cut again where all keep theirs, folded otherwise if need be. Each round cuts the folds that lie
/// between the most tabs and what stands in their way (greedy set cover over tree paths, as in
/// overlap_split.hpp); the best of several attempts is kept. Single flat regions stay whole, all pieces fit
/// the room. Every tab that is counted was placed by place_tabs. Deterministic for one seed but for the
/// deadline, at which it returns what it has. `patch`: of the whole surface.
[[nodiscard]] TabSplit split_for_tabs(const mesh::Surface& surface, const prepare::Panels& panels,
                                      const Patch& patch, const Folds& folds, const Room& room,
                                      const TabOptions& options, const NetsOf& nets_of, double tolerance,
                                      std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
