// SPDX-License-Identifier: GPL-3.0-or-later
// Does it fit the sheet? Convex hulls and the turn that brings one into a rectangle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/vector.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {

/// Corners counterclockwise, no three collinear; of fewer than three different points, those points.
[[nodiscard]] std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// The angle (radians, counterclockwise) by which a convex polygon is turned so that its extents along x and
/// y are at most the sheet's width and height; none when there is none. Exact but for 1e-7 mm: where any
/// angle fits, one fits at which an extent equals the sheet's, or all do. O(m^2), m corners.
[[nodiscard]] std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Sheet& sheet);

}  // namespace ridgecraft::unfold
