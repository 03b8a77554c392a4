// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of polygons in the plane.
#pragma once

#include <cstddef>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft {

/// Twice the signed area of a closed polygon, positive when it runs counterclockwise; measured from the first
/// corner, so that a small polygon far from the origin keeps its digits.
[[nodiscard]] inline double doubled_area(std::span<const Vec2> polygon) {
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}

}  // namespace ridgecraft
