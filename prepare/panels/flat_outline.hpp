// SPDX-License-Identifier: GPL-3.0-or-later
// What the sides of a flat region enclose, by the numbers of its points. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/geometry.hpp"

namespace ridgecraft::prepare {

/// From a point to the next one, as the region's faces run.
using OutlineSide = std::array<std::uint32_t, 2>;

/// The points of the sides, each once, ascending.
[[nodiscard]] std::vector<std::uint32_t> points_of(const std::vector<OutlineSide>& sides);

/// Triangles of what the sides enclose in the frame's plane (constrained Delaunay), in an order that depends
/// on the numbers of the points; none where sides cross or overlap. `places`: where each point is. O(n log
/// n).
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_between(
    std::vector<OutlineSide> sides, const std::vector<Vec3>& places, const PlaneFrame& frame);

}  // namespace ridgecraft::prepare
