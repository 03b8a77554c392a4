// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hulls of points in the plane.
#pragma once

#include <vector>

#include "mesh/foundation/vector.hpp"

namespace ridgecraft {

/// Corners counterclockwise, no three collinear but for rounding; of fewer than three different points, those
/// points. O(n log n): the monotone chain (A. Andrew, Information Processing Letters 9, 1979).
[[nodiscard]] std::vector<Vec2> convex_hull(std::vector<Vec2> points);

}  // namespace ridgecraft
