// SPDX-License-Identifier: GPL-3.0-or-later
// The surface as the segmentation sees it: in the scale of its enclosing ball, on an exact grid, in flat
// arrays; with the exact predicates and the ball that it needs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/int128.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

// Exact signs of orientation for points on a grid of 2^-40, which 128-bit integers hold without rounding.

/// Grid steps in one unit (the radius of the model's enclosing ball). Coordinates are at most 1 in size, so
/// differences have 41 bits and a sign, products of three of them 126: the largest power of two that 128-bit
/// integers allow. One step, 1e-12, is also how exactly the enclosing ball is known.
inline constexpr double grid_steps = 0x1p40;

/// Integer coordinates of a point on the grid.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// Nearest point of the grid.
[[nodiscard]] inline Vec3 snap_to_grid(Vec3 p) {
  return {std::nearbyint(p.x * grid_steps) / grid_steps, std::nearbyint(p.y * grid_steps) / grid_steps,
          std::nearbyint(p.z * grid_steps) / grid_steps};
}

/// Coordinates of a point that snap_to_grid made; exact.
[[nodiscard]] inline GridPoint grid_point(Vec3 p) {
  return {static_cast<std::int64_t>(p.x * grid_steps), static_cast<std::int64_t>(p.y * grid_steps),
          static_cast<std::int64_t>(p.z * grid_steps)};
}

[[nodiscard]] inline int sign_of(Int128 value) {
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

/// (b - a) x (c - a), exactly.
struct GridNormal {
  Int128 x, y, z;
};
[[nodiscard]] inline GridNormal grid_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const Int128 ux = b.x - a.x;
  const Int128 uy = b.y - a.y;
  const Int128 uz = b.z - a.z;
  const Int128 vx = c.x - a.x;
  const Int128 vy = c.y - a.y;
  const Int128 vz = c.z - a.z;
  return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

/// Sign of ((b - a) x (c - a)) . (d - a): 1 when d is on the side from which a, b, c run counterclockwise.
[[nodiscard]] inline int exact_orientation(Vec3 pa, Vec3 pb, Vec3 pc, Vec3 pd) {
  const GridPoint a = grid_point(pa);
  const GridPoint d = grid_point(pd);
  const GridNormal n = grid_normal(a, grid_point(pb), grid_point(pc));
  return sign_of(n.x * (d.x - a.x) + n.y * (d.y - a.y) + n.z * (d.z - a.z));
}

/// Whether three points of space lie on one line.
[[nodiscard]] inline bool exactly_collinear(Vec3 pa, Vec3 pb, Vec3 pc) {
  const GridNormal n = grid_normal(grid_point(pa), grid_point(pb), grid_point(pc));
  return n.x == 0 && n.y == 0 && n.z == 0;
}

// The smallest ball around a set of points, which gives the scale of concavity.

struct Ball {
  Vec3 center;
  double radius = 0.0;
};

/// Smallest enclosing ball of points whose coordinates are about 1 in size, by pivoting: the farthest point
/// joins a support of at most four, until no point is outside by more than 1e-12. Typically ten passes of
/// O(n). No points: radius 0. Why not CGAL's: docs/design/segmentation.md, "What is written by hand, and
/// why".
[[nodiscard]] Ball smallest_enclosing_ball(std::span<const Vec3> points);

/// Facets of a part, ascending.
using Facets = std::vector<std::uint32_t>;

/// How facets and vertices are numbered.
enum class Numbering {
  kept,         ///< as in the surface
  along_curve,  ///< as a space-filling curve runs: what is near in space is near in memory
};

/// Built once, then only read.
struct ScaledSurface {
  std::vector<Vec3> points;  ///< enclosing ball = unit ball about the origin; on the exact grid
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
