// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces with equal nets get equal tabs, too, where what they are glued to allows it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/tab_wishes.hpp"

namespace ridgecraft::unfold {

/// Gives pieces whose nets are equal without tabs the tabs of that one of them which most of the others can
/// have them of, where no join loses its tab or what `wishes` (of each join, or none) ask of it. If more can
/// have them without those of joins between pieces of one kind, these stay as they are. `nets` have no tabs;
/// `chosen`: of each join. Tabs stay clear of everything that `sites` name. O(n log n) for each of a few
/// pieces of a kind.
void even_tabs(const mesh::Surface& surface, const Nets& nets, const std::vector<TabSite>& sites,
               const TabOptions& options, std::span<const TabWish> wishes,
               std::vector<std::optional<ChosenTab>>& chosen);

/// The mirror image of a tab on an edge of this length.
[[nodiscard]] ConvexShape turned_over(const ConvexShape& shape, double length);

}  // namespace ridgecraft::unfold
