// SPDX-License-Identifier: GPL-3.0-or-later
// Distances between convex polygons, exactly: the packer works on bitmaps, and this checks what it made.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Distance of two convex polygons; 0 where they meet.
[[nodiscard]] double convex_distance(std::span<const Vec2> a, std::span<const Vec2> b);

/// A convex polygon and the piece that it belongs to.
struct OwnedPolygon {
  std::uint32_t owner;
  std::vector<Vec2> corners;
};

/// Pairs of owners of which some polygons are nearer to each other than `gap`, each once, the smaller number
/// first, ascending. A sweep over x: O(n log n) and the pairs whose boxes are near each other.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> too_near(
    const std::vector<OwnedPolygon>& polygons, double gap);

}  // namespace ridgecraft::export_
