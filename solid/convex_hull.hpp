// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hulls with exact predicates (CGAL).
#pragma once

#include <span>

#include "base/vector.hpp"
#include "solid/body.hpp"

namespace ridgecraft::solid {

/// The convex hull of points: its corners are some of them, so nothing is rounded. Points without volume are
/// given `thickness` first, to both sides. At least one point. O(n log n).
[[nodiscard]] Body convex_hull(std::span<const Vec3> points, double thickness);

/// True when no point lies outside a convex body, by exact predicates. O(points * triangles).
[[nodiscard]] bool encloses(const Body& convex, std::span<const Vec3> points);

/// Grows a convex body about its middle by a few units in the last place, again and again, until it encloses
/// the points. Rounding is what it mends; the caller sees to it that it nearly encloses them before.
void grow_until_enclosing(Body& convex, std::span<const Vec3> points);

}  // namespace ridgecraft::solid
