// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions with fewer corners, or several as one. Private to prepare/.
#pragma once

#include <cstdint>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/panel_regions.hpp"

namespace ridgecraft::prepare {

struct MergedRegions {
  mesh::LooseFaces faces;
  /// Regions that can't become what is asked for, as their outline would cross itself or turn over; the faces
  /// are of no use where there are any.
  std::vector<std::uint32_t> failed;
};

/// What is to be done to regions. `loose` and `regions` are of `surface`.
struct RegionChanges {
  /// The regions of each set become one.
  DisjointSets sets;
  /// These points are taken out of all outlines: two sides of a set's outline must meet there.
  std::vector<bool> gone;
  /// Of each point: the one that it becomes; itself for most. Sides between points that become one vanish,
  /// and so do regions of which fewer than three sides are left.
  std::vector<std::uint32_t> becomes;
  /// Where the points are then.
  std::vector<Vec3> places;

  RegionChanges(const mesh::LooseFaces& loose, const PanelRegions& regions);
};

/// Each set that this changes is triangulated anew (constrained Delaunay). O(n log n).
[[nodiscard]] MergedRegions merged_regions(const mesh::Surface& surface, const mesh::LooseFaces& loose,
                                           const PanelRegions& regions, RegionChanges& changes);

}  // namespace ridgecraft::prepare
