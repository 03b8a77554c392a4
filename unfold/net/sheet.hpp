// SPDX-License-Identifier: GPL-3.0-or-later
// Does it fit the sheet? The turn that brings a convex polygon into a rectangle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/convex_hull.hpp"
#include "base/vector.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// The angle (radians, counterclockwise) by which a convex polygon is turned so that its extents along x and
/// y are at most the sheet's width and height; none when there is none. Exact but for 1e-7 mm: where any
/// angle fits, one fits at which an extent equals the sheet's, or all do. O(m^2), m corners.
[[nodiscard]] std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Sheet& sheet);

}  // namespace ridgecraft::unfold
