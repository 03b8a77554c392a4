// SPDX-License-Identifier: GPL-3.0-or-later
// The space between a part and its hull: volumes of unions of hulls, and whether air lies deep under a hull,
// which is what --pockets promises about (docs/design/segmentation.md, "More effort, smaller hulls, no
// pockets").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/hull_depth.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

// Where a grid of rays parallel to z passes through hulls: volumes of unions of hulls.

/// Half the side of a grid of rays: a little more than the unit ball, so that no hull lies on its rim.
inline constexpr double grid_reach = 1.001;

/// Square cells over the unit ball, with a ray parallel to z through the centre of each.
class RayGrid {
 public:
  explicit RayGrid(std::uint32_t rays_a_side) : rays_(rays_a_side) {}

  [[nodiscard]] std::size_t cell_count() const { return std::size_t{rays_} * rays_; }
  /// Side of a cell.
  [[nodiscard]] double step() const { return 2.0 * grid_reach / rays_; }

  /// Calls visit(cell, u, v) for each ray that may meet a triangle, with weights u, v, 1 - u - v of its
  /// corners where it meets the triangle's plane: within it where none is below 0. Not for a triangle that is
  /// seen edge-on: its neighbours have its border.
  template <class Visit>
  void for_rays_near(Vec3 a, Vec3 b, Vec3 c, const Visit& visit) const {
    const double area = cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y});
    if (area == 0.0) {
      return;
    }
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const std::uint32_t last_i = ray_after(high_x);
    const std::uint32_t last_j = ray_after(high_y);
    for (std::uint32_t j = ray_after(low_y); j < last_j; ++j) {
      for (std::uint32_t i = ray_after(low_x); i < last_i; ++i) {
        const Vec2 p{center(i), center(j)};
        visit(j * rays_ + i, cross(Vec2{c.x - b.x, c.y - b.y}, Vec2{p.x - b.x, p.y - b.y}) / area,
              cross(Vec2{a.x - c.x, a.y - c.y}, Vec2{p.x - c.x, p.y - c.y}) / area);
      }
    }
  }

 private:
  [[nodiscard]] double center(std::uint32_t i) const { return -grid_reach + (i + 0.5) * step(); }
  /// First ray at x or beyond.
  [[nodiscard]] std::uint32_t ray_after(double x) const {
    const double at = std::ceil((x + grid_reach) / step() - 0.5);
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, static_cast<double>(rays_)));
  }

  std::uint32_t rays_;
};

/// Rays a side of the grid that segmenting uses.
inline constexpr std::uint32_t rays_a_side = 64;
inline constexpr std::uint32_t ray_count = rays_a_side * rays_a_side;

/// The stretch of one ray inside a hull.
struct RaySpan {
  std::uint32_t ray = 0;
  float low = 0.0F;
  float high = 0.0F;
};

/// Volume that one unit of length on one of these rays stands for.
[[nodiscard]] double volume_per_length();

/// The stretches inside a hull, ascending by ray; none for a flat hull. O(triangles + rays met).
[[nodiscard]] std::vector<RaySpan> cast_rays(const Hull& hull, std::span<const Vec3> points);

/// Length of the union of stretches of one ray, from `low` to `high`; sorts them.
template <class Span>
[[nodiscard]] double union_length(std::vector<Span>& spans) {
  std::sort(spans.begin(), spans.end(), [](const Span& s, const Span& t) { return s.low < t.low; });
  double sum = 0.0;
  double reached = -INFINITY;
  for (const Span& s : spans) {
    const auto low = static_cast<double>(s.low);
    const auto high = static_cast<double>(s.high);
    sum += std::max(0.0, high - std::max(low, reached));
    reached = std::max(reached, high);
  }
  return sum;
}

// The centre of the largest ball in a convex body.

/// Points p with dot(normal, p) <= offset; unit normals.
struct HalfSpace {
  Vec3 normal;
  double offset = 0.0;
};

struct DeepestPoint {
  Vec3 point;
  double depth = 0.0;  ///< under the nearest plane
};

/// The point inside all half spaces and the box [-2, 2]^3 that lies deepest under their planes; none when
/// they have no common point. Linear programme in four variables by R. Seidel's incremental algorithm
/// ("Small- dimensional linear programming and convex hulls made easy", 1991): expected O(n).
[[nodiscard]] std::optional<DeepestPoint> deepest_point(std::span<const HalfSpace> half_spaces);

/// Tests hulls against the solid that a closed surface encloses. A pocket is a point outside the solid that
/// lies deeper than a tolerance under every face of the hull. What lies so deep is a convex body, the hull
/// with its faces moved inward; it holds air exactly when its deepest point is air or a face of the surface
/// with air at it reaches into it. So the answer is exact, not sampled.
class PocketTest {
 public:
  PocketTest(const ScaledSurface& surface, double tolerance);

  /// Whether there is a solid to speak of: no border edges.
  [[nodiscard]] static bool encloses(const ScaledSurface& surface);

  /// O(facets of the surface) when the hull is thicker than twice the tolerance.
  [[nodiscard]] bool has_pocket(const Hull& hull);

  /// Winding number of the surface about a point that isn't on it. O(facets).
  [[nodiscard]] int winding(Vec3 point) const;

 private:
  void find_planes(const Hull& hull);
  [[nodiscard]] bool reaches_in(std::uint32_t facet, std::size_t& last, Vec3& where) const;
  [[nodiscard]] bool has_air_beside(std::uint32_t facet, Vec3 where);

  const ScaledSurface* surface_;
  double tolerance_;
  std::vector<HullPlane> hull_planes_;
  std::vector<HalfSpace> planes_;  ///< the same, moved inward by the tolerance
  std::vector<std::int8_t> air_;   ///< per facet: whether air is at it, -1 not known yet
};

}  // namespace ridgecraft::segment
