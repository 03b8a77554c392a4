// SPDX-License-Identifier: GPL-3.0-or-later
// Distances from straight segments, in the plane and in space.
#pragma once

#include <algorithm>

#include "base/vector.hpp"

namespace ridgecraft {

/// The point of the segment from a to b that is nearest to p. `Point` is Vec2 or Vec3.
template <class Point>
[[nodiscard]] inline Point nearest_on_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double share = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return a + share * along;
}

template <class Point>
[[nodiscard]] inline double distance_to_segment(Point p, Point a, Point b) {
  return length(p - nearest_on_segment(p, a, b));
}

}  // namespace ridgecraft
