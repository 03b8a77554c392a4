// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions: their outlines, triangles of what these enclose, several regions as one. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// From a point to the next one, as the region's faces run.
using OutlineSide = std::array<std::uint32_t, 2>;

/// The points of the sides, each once, ascending.
[[nodiscard]] std::vector<std::uint32_t> points_of(const std::vector<OutlineSide>& sides);

/// Triangles of what the sides enclose in the frame's plane (constrained Delaunay), in an order that depends
/// on the numbers of the points; none where sides cross or overlap. `places`: where each point is. O(n log
/// n).
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_between(
    std::vector<OutlineSide> sides, const std::vector<Vec3>& places, const PlaneFrame& frame);

/// The flat regions that are remeshed as one: panels, divided where the material changes. Faces, edges and
/// vertices are those of the surface, by plain numbers. Refers to the surface.
class PanelRegions {
 public:
  /// `loose` are the surface's faces taken apart, for their materials. O(n).
  PanelRegions(const mesh::Surface& surface, const Panels& panels, const mesh::LooseFaces& loose);

  [[nodiscard]] std::size_t count() const { return faces_.size(); }
  [[nodiscard]] std::uint32_t region(std::uint32_t face) const { return region_[face]; }
  [[nodiscard]] const std::vector<std::uint32_t>& faces(std::uint32_t region) const { return faces_[region]; }
  /// The edges between two regions, or of one and the surface's border, that end at a vertex.
  [[nodiscard]] const std::vector<std::uint32_t>& border_edges(std::uint32_t vertex) const {
    return border_edges_[vertex];
  }
  [[nodiscard]] bool on_border(EdgeId edge) const;

 private:
  void find_regions(const Panels& panels, const mesh::LooseFaces& loose);
  void find_borders();

  const mesh::Surface& surface_;
  std::vector<std::uint32_t> region_;                     ///< of each face
  std::vector<std::vector<std::uint32_t>> faces_;         ///< of each region
  std::vector<std::vector<std::uint32_t>> border_edges_;  ///< of each vertex
};

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
