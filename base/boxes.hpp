// SPDX-License-Identifier: GPL-3.0-or-later
// Axis-parallel boxes, in the plane and in space: where they are, and whether they meet.
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// The smallest box around the points; empty where there are none.
[[nodiscard]] inline Box2 box_of(std::span<const Vec2> points) {
  Box2 box;
  for (const Vec2 p : points) {
    box.add(p);
  }
  return box;
}
[[nodiscard]] inline Box2 box_of(std::span<const std::vector<Vec2>> lines) {
  Box2 box;
  for (const std::vector<Vec2>& line : lines) {
    for (const Vec2 p : line) {
      box.add(p);
    }
  }
  return box;
}

/// The box grown by `margin` on all sides.
[[nodiscard]] inline Box2 grown(const Box2& box, double margin) {
  return {box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}
[[nodiscard]] inline Box3 grown(const Box3& box, double margin) {
  return {box.low - Vec3{margin, margin, margin}, box.high + Vec3{margin, margin, margin}};
}

/// Do the closed boxes have a point in common?
[[nodiscard]] inline bool meet(const Box2& a, const Box2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
[[nodiscard]] inline bool meet(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

[[nodiscard]] inline Vec3 centre(const Box3& box) {
  return 0.5 * (box.low + box.high);
}

}  // namespace ridgecraft
