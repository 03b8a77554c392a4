// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest ball around a set of points, which gives the scale of concavity.
#pragma once

#include <span>

#include "base/vector.hpp"

namespace ridgecraft::segment {

struct Ball {
  Vec3 center;
  double radius = 0.0;
};

/// Smallest enclosing ball of points whose coordinates are about 1 in size, by pivoting: the farthest point
/// joins a support of at most four, until no point is outside by more than 1e-12. Typically ten passes of
/// O(n). No points: radius 0. Why not CGAL's: docs/design/segmentation.md, "What is written by hand, and
/// why".
[[nodiscard]] Ball smallest_enclosing_ball(std::span<const Vec3> points);

}  // namespace ridgecraft::segment
