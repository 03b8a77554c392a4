// SPDX-License-Identifier: GPL-3.0-or-later
// Does it fit the sheet? The turn that brings a convex polygon into a rectangle.
#pragma once

#include <optional>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft {

/// A rectangle that may lie anywhere.
struct Rectangle {
  double width = 0.0;
  double height = 0.0;
};

/// The angle (radians, counterclockwise) by which a convex polygon is turned so that its extents along x and
/// y are at most the rectangle's width and height; none when there is none. Exact but for 1e-7: where any
/// angle fits, one fits at which an extent equals the rectangle's, or all do. O(m^2) for m corners up to 64,
/// O(m log m) beyond.
[[nodiscard]] std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Rectangle& rectangle);

}  // namespace ridgecraft
