// SPDX-License-Identifier: GPL-3.0-or-later
// The centre of the largest ball in a convex body.
#pragma once

#include <optional>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft::segment {

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

}  // namespace ridgecraft::segment
