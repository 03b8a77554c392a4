// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles inside a plane outline that may be concave and have holes. Keeps CGAL out of
// headers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Constrained Delaunay triangulation of what lies inside the segments, counted by crossings (odd is inside;
/// a segment that is there twice, such as the bridge to a hole, bounds nothing). Every segment is a side of
/// the result; the triangles are counterclockwise and have positive area. None where segments cross or
/// overlap, a point lies on a segment or on another point. O(n log n) in practice.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate_inside(
    std::span<const Vec2> points, std::span<const std::array<std::uint32_t, 2>> segments);

}  // namespace ridgecraft
