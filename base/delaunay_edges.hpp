// SPDX-License-Identifier: GPL-3.0-or-later
// Which points of space are neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Pairs of points that hold a shortest spanning tree of them all: the edges of their Delaunay triangulation,
/// and for points at one place the pairs of each with the one before it. Each pair ascends; in no order that
/// matters, but the same for the same points. Points finite. Expected O(n log n).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> delaunay_edges(std::span<const Vec3> points);

}  // namespace ridgecraft
