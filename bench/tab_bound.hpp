// SPDX-License-Identifier: GPL-3.0-or-later
// What geometry allows at most: which edges can have a usable tab at all, whatever the net.
#pragma once

#include <cstdint>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::bench {

/// Upper bounds for any single net whose flat regions stay whole.
struct TabBound {
  double edges = 0.0;      ///< share of the edges between flat regions that can have a usable tab
  double cuts = 0.0;       ///< largest share that the cuts of a net can have
  double long_cuts = 0.0;  ///< the same for the cuts longer than long_edge_mm alone
  IdVector<EdgeId, std::uint8_t> able;  ///< 1: this edge can have a usable tab
};

/// Longer edges count as long, mm: there a missing tab is missed most.
inline constexpr double long_edge_mm = 8.0;

/// An edge can have a usable tab when behind one of its sides the flat region is, 3 mm above the edge, at
/// least half as wide as the edge is long: no shape of a tab, no angle and no height is assumed, and nothing
/// stands in its way. The edges that are cut are what a spanning tree of the flat regions leaves, so the best
/// net is a spanning tree of greatest weight (exact). O(n log n) but for panels of very many faces.
[[nodiscard]] TabBound tab_bound(const mesh::Surface& surface, const prepare::Panels& panels);

}  // namespace ridgecraft::bench
