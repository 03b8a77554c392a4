// SPDX-License-Identifier: GPL-3.0-or-later
// Which of its two sides gives each join's tab, and in which shape, so that no two tabs collide.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/tab_requests.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// A tab that was chosen for a join.
struct ChosenTab {
  std::uint32_t site = 0;
  TabShape shape;  ///< in the frame of the site; its cost includes that of the side
};

/// Do two tabs on different sites keep the clearance? Those that share a corner of their bases may touch
/// there.
[[nodiscard]] bool tabs_clear(const TabSite& a, const ConvexShape& tab_a, const TabSite& b,
                              const ConvexShape& tab_b, double clearance_mm);

/// A tab on another site of the same piece as an obstacle in the frame of `here`.
[[nodiscard]] Obstacle tab_as_obstacle(const TabSite& here, const TabSite& other, const ConvexShape& tab);

/// Chooses a tab for as many joins as it can, then the cheapest ones (TabCosts). `preferred[j]` is 0 or 1:
/// the side of join j that should give the tab. Joins are treated from the most constrained to the least; one
/// that finds no place may push one other tab to another place. `requests`, one for each join or none at all,
/// count more than what is preferred and `options`. Deterministic; O(n log n) for nets whose tabs
/// have few neighbours.
[[nodiscard]] std::vector<std::optional<ChosenTab>> assign_tabs(const std::vector<TabSite>& sites,
                                                                const std::vector<std::uint8_t>& preferred,
                                                                const TabOptions& options,
                                                                const Context& context,
                                                                std::span<const TabRequest> requests = {});

}  // namespace ridgecraft::unfold
