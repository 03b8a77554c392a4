// SPDX-License-Identifier: GPL-3.0-or-later
// What must be true of every body, by code that shares nothing with solid/.
#pragma once

#include <span>

#include "base/vector.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::test {

/// Every edge has two triangles that run along it in opposite directions, and every vertex one fan.
[[nodiscard]] bool closed_and_manifold(const solid::Body& body);

/// How often the body winds round a point: 1 inside, 0 outside (sum of solid angles).
[[nodiscard]] double winding_number(const solid::Body& body, Vec3 p);

/// Largest distance of a point beyond a plane of a convex body; not above 0 when it encloses them.
[[nodiscard]] double largest_excess(const solid::Body& convex, std::span<const Vec3> points);

}  // namespace ridgecraft::test
