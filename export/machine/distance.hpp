// SPDX-License-Identifier: GPL-3.0-or-later
// How far a point is from a stretch of a line.
#pragma once

#include <algorithm>

#include "base/vector.hpp"

namespace ridgecraft::paper {

/// From the stretch between a and b, which may be one point.
[[nodiscard]] inline double distance_to_side(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return length(p - (a + t * along));
}

}  // namespace ridgecraft::paper
