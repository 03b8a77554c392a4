// SPDX-License-Identifier: GPL-3.0-or-later
// Where a grid of rays parallel to z passes through hulls: volumes of unions of hulls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/hull.hpp"

namespace ridgecraft::segment {

/// Rays a side of the grid over the unit ball.
inline constexpr std::uint32_t rays_a_side = 64;
inline constexpr std::uint32_t ray_count = rays_a_side * rays_a_side;

/// The stretch of one ray inside a hull.
struct RaySpan {
  std::uint32_t ray = 0;
  float low = 0.0F;
  float high = 0.0F;
};

/// Volume of the unit ball's space that one unit of length on one ray stands for.
[[nodiscard]] double volume_per_length();

/// The stretches inside a hull, ascending by ray; none for a flat hull. O(triangles + rays met).
[[nodiscard]] std::vector<RaySpan> cast_rays(const Hull& hull, std::span<const Vec3> points);

/// Length of the union of stretches of one ray; sorts them.
[[nodiscard]] double union_length(std::vector<RaySpan>& spans);

}  // namespace ridgecraft::segment
