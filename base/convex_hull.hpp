// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hulls of points in the plane.
#pragma once

#include <cstddef>
#include <ranges>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Corners of the hull, counterclockwise, of points in the order of x, then y; none at all where they are one
/// place. `turn(a, b, c)` is above 0 where c lies left of the line from a to b. `hull` is written over. O(n):
/// the monotone chain (A. Andrew, Information Processing Letters 9, 1979).
template <std::ranges::random_access_range Points, class Turn, class Point>
void monotone_chain(const Points& sorted, const Turn& turn, std::vector<Point>& hull) {
  hull.clear();
  if (std::ranges::empty(sorted)) {
    return;
  }
  const auto add = [&](const Point& p, std::size_t keep) {
    while (hull.size() >= keep + 2 && !(turn(hull[hull.size() - 2], hull.back(), p) > 0)) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Point& p : sorted) {
    add(p, 0);
  }
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) {
    add(sorted[i], lower);
  }
  hull.pop_back();
}

/// Corners counterclockwise, no three collinear but for rounding; of fewer than three different points, those
/// points. O(n log n).
[[nodiscard]] std::vector<Vec2> convex_hull(std::vector<Vec2> points);

}  // namespace ridgecraft
