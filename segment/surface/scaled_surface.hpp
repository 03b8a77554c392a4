// SPDX-License-Identifier: GPL-3.0-or-later
// The surface as the segmentation sees it: in the scale of its enclosing ball, on an exact grid, in flat
// arrays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

/// "No facet", "no vertex" and so on in the flat arrays of this folder.
inline constexpr std::uint32_t none = 0xffffffffU;

/// Facets of a part, ascending.
using Facets = std::vector<std::uint32_t>;

/// How facets and vertices are numbered.
enum class Numbering {
  kept,         ///< as in the surface
  along_curve,  ///< as a space-filling curve runs: what is near in space is near in memory
};

/// Built once, then only read.
struct ScaledSurface {
  std::vector<Vec3>
      points;  ///< enclosing ball = unit ball about the origin; on the grid of exact_orientation.hpp
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< across the side from corner k to k + 1, or none
  std::vector<std::uint32_t> vertex_first;              ///< facets of v: vertex_facets[vertex_first[v] ...]
  std::vector<std::uint32_t> vertex_facets;
  std::vector<Vec3> vertex_normals;  ///< facets' normals weighted by their angle at the vertex; unit or zero
  /// Facets of one polygon that hang together over edges have one group; empty when every facet is its own.
  std::vector<std::uint32_t> group;
  std::vector<std::uint32_t> group_first;  ///< facets of a group: group_facets[group_first[g] ...]
  std::vector<std::uint32_t> group_facets;
  /// Numbers in the surface, of each facet and vertex; empty when they are the same.
  std::vector<std::uint32_t> face_of;
  std::vector<std::uint32_t> vertex_of;
  double unit = 1.0;  ///< length of the ball's radius in the surface's unit

  [[nodiscard]] std::size_t facet_count() const { return corners.size(); }
  /// Unit, or zero for a facet without area. Not kept: few ask for it, and it would be nearly a quarter of
  /// all this.
  [[nodiscard]] Vec3 facet_normal(std::uint32_t f) const {
    const auto& [a, b, c] = corners[f];
    return normalized(cross(points[b] - points[a], points[c] - points[a]));
  }
  /// Of the side 3 f + k: from corner k of facet f to the next one.
  [[nodiscard]] double side_length(std::size_t side) const {
    const std::array<std::uint32_t, 3>& facet = corners[side / 3];
    return length(points[facet[(side + 1) % 3]] - points[facet[side % 3]]);
  }
  [[nodiscard]] std::size_t vertex_count() const { return points.size(); }
  [[nodiscard]] std::span<const std::uint32_t> facets_at(std::uint32_t v) const {
    return {vertex_facets.data() + vertex_first[v], vertex_first[v + 1] - vertex_first[v]};
  }
  [[nodiscard]] bool same_group(std::uint32_t f, std::uint32_t g) const {
    return !group.empty() && group[f] == group[g];
  }
  /// The facets that must stay with f, itself included.
  [[nodiscard]] std::span<const std::uint32_t> facets_with(const std::uint32_t& f) const {
    if (group.empty()) {
      return {&f, 1};
    }
    const std::uint32_t g = group[f];
    return {group_facets.data() + group_first[g], group_first[g + 1] - group_first[g]};
  }
};

/// `polygon` as in segment(). O(n).
[[nodiscard]] ScaledSurface scale_surface(const mesh::Surface& surface,
                                          std::span<const std::uint32_t> polygon,
                                          Numbering numbering = Numbering::kept);

/// Finds the facets at each vertex and all normals again, after points, corners or neighbours changed. O(n).
void index_and_orient(ScaledSurface& surface);

/// Facets from number `facets_before` on, which were added, become polygons of their own.
void extend_groups(ScaledSurface& surface, std::size_t facets_before);

}  // namespace ridgecraft::segment
