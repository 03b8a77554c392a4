// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulations, of outlines in the plane and of points in space. Keeps CGAL out of headers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

// Triangles inside a plane outline that may be concave and have holes.

/// Constrained Delaunay triangulation of what lies inside the segments, counted by crossings (odd is inside;
/// a segment that is there twice, such as the bridge to a hole, bounds nothing). Every segment is a side of
/// the result; the triangles are counterclockwise and have positive area. None where segments cross or
/// overlap, a point lies on a segment or on another point. O(n log n) in practice.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate_inside(
    std::span<const Vec2> points, std::span<const std::array<std::uint32_t, 2>> segments);

// Which points of space are neighbours.

/// Pairs of points that hold a shortest spanning tree of them all: the edges of their Delaunay triangulation,
/// and for points at one place the pairs of each with the one before it. Each pair ascends; in no order that
/// matters, but the same for the same points. Points finite. Expected O(n log n).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> delaunay_edges(std::span<const Vec3> points);

}  // namespace ridgecraft
