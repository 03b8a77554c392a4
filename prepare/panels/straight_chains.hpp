// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices between flat regions are needed. Private to prepare/.
#pragma once

#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/panels/panel_regions.hpp"

namespace ridgecraft::prepare {

/// Which vertices stay: corners where other than two region borders meet, all of the regions that are frozen,
/// and what it takes to keep each chain of edges between them straight within the tolerance (Douglas and
/// Peucker's rule). A closed chain keeps three at least, and two chains never become the same side. O(n log
/// n) but for chains that take the rule's worst case.
[[nodiscard]] std::vector<bool> vertices_that_stay(const mesh::Surface& surface, const PanelRegions& regions,
                                                   const std::vector<bool>& frozen, double tolerance);

}  // namespace ridgecraft::prepare
