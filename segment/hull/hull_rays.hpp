// SPDX-License-Identifier: GPL-3.0-or-later
// Where a grid of rays parallel to z passes through hulls: volumes of unions of hulls.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "segment/hull/hull.hpp"

namespace ridgecraft::segment {

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

/// Length of the union of stretches of one ray; sorts them.
[[nodiscard]] double union_length(std::vector<RaySpan>& spans);

}  // namespace ridgecraft::segment
