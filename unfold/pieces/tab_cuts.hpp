// SPDX-License-Identifier: GPL-3.0-or-later
// Which folds to cut so that tabs get room: those that lie between many tabs and what stands in their way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"

namespace ridgecraft::unfold {

/// Chooses folds, one side of each, until each gap has a place from which all that stands in its way is cut
/// off, as far as cutting can do that: the fold that does most for all gaps first (greedy set cover, V.
/// Chvatal 1979, over tree paths). What the tabs of the new cuts need isn't foreseen. `blur` of 0 or more
/// makes the order random by so much. `patch`: of the whole surface. O(cuts (gaps + folds on their paths)).
/// Throws Error(interrupted).
[[nodiscard]] std::vector<std::uint32_t> choose_tab_cuts(const mesh::Surface& surface, const Patch& patch,
                                                         const Folds& folds, const TabGaps& tab_gaps,
                                                         std::span<const TabGap> gaps, double blur,
                                                         Random& random, const Context& context);

}  // namespace ridgecraft::unfold
