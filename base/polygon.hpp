// SPDX-License-Identifier: GPL-3.0-or-later
// Measures and parts of polygons and of lines of several stretches.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Twice the signed area of a closed polygon, positive when it runs counterclockwise; measured from the first
/// corner, so that a small polygon far from the origin keeps its digits.
[[nodiscard]] inline double doubled_area(std::span<const Vec2> polygon) {
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}

/// Whether a point lies in what closed polygons bound, by the even-odd rule: holes are outside. Points on a
/// side are on either side of it. O(n).
[[nodiscard]] inline bool inside(std::span<const std::vector<Vec2>> loops, Vec2 p) {
  bool odd = false;
  for (const std::vector<Vec2>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
        odd = !odd;
      }
    }
  }
  return odd;
}

/// Of an open line through these points.
[[nodiscard]] inline double length_of(std::span<const Vec2> line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += length(line[i] - line[i - 1]);
  }
  return sum;
}

/// The part of a polygon where `height`, an affine function of the place, isn't negative; fewer than three
/// corners where it is negative everywhere. Convex polygons stay convex; parts of others hang together along
/// the line of height 0. O(n).
template <class Point, class Height>
[[nodiscard]] std::vector<Point> part_where(const std::vector<Point>& polygon, Height height) {
  std::vector<Point> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point p = polygon[i];
    const Point q = polygon[(i + 1) % polygon.size()];
    const double at_p = height(p);
    const double at_q = height(q);
    if (at_p >= 0.0) {
      part.push_back(p);
    }
    if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) {
      part.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
  }
  return part;
}

}  // namespace ridgecraft
