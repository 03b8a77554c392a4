// SPDX-License-Identifier: GPL-3.0-or-later
// Exact signs of orientation for points on a grid of 2^-40, which 128-bit integers hold without rounding.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/int128.hpp"
#include "base/vector.hpp"

namespace ridgecraft::segment {

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

}  // namespace ridgecraft::segment
