// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/elementary.hpp"
#include "base/segment.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/box_finder.hpp"

namespace ridgecraft::verify {
namespace {

/// The two segments have a point in common, or come as near as `touch`.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double touch) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  const bool crosses = ((c_side < 0.0) != (d_side < 0.0)) && ((a_side < 0.0) != (b_side < 0.0)) &&
                       c_side != 0.0 && d_side != 0.0 && a_side != 0.0 && b_side != 0.0;
  return crosses || distance_to_segment(a, c, d) <= touch || distance_to_segment(b, c, d) <= touch ||
         distance_to_segment(c, a, b) <= touch || distance_to_segment(d, a, b) <= touch;
}

/// Side b c, which follows on a b, runs back along it.
bool runs_back(Vec2 a, Vec2 b, Vec2 c, double touch) {
  return dot(b - a, c - b) < 0.0 &&
         (distance_to_segment(c, a, b) <= touch || distance_to_segment(a, b, c) <= touch);
}

}  // namespace

Box2 bounding_box(std::span<const Vec2> corners) {
  Box2 box;
  for (const Vec2 corner : corners) {
    box.add(corner);
  }
  return box;
}

bool is_convex(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  double turned = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % n];
    const Vec2 c = polygon[(i + 2) % n];
    const double turn = cross(b - a, c - b);
    // turn over the chord is how far b lies outside the chord from a to c.
    if (turn < -dent_tolerance_mm * length(c - a)) {
      return false;
    }
    turned += elementary::atan2(turn, dot(b - a, c - b));
  }
  // Several rounds are a star. What the tolerance lets pass is far less than half a round.
  return std::abs(turned - 2.0 * std::numbers::pi) < 1.0;
}

bool is_simple(std::span<const Vec2> polygon, const Context& context) {
  const std::size_t n = polygon.size();
  if (n == 3) {
    return doubled_area(polygon) != 0.0;
  }
  double largest = 0.0;
  for (const Vec2 corner : polygon) {
    largest = std::max({largest, std::abs(corner.x), std::abs(corner.y)});
  }
  const double touch = touch_share * largest;
  const Vec2 margin{touch, touch};
  std::vector<Box2> boxes(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % n];
    if (a == b || runs_back(a, b, polygon[(i + 2) % n], touch)) {
      return false;
    }
    boxes[i].add(a);
    boxes[i].add(b);
    boxes[i] = {boxes[i].low - margin, boxes[i].high + margin};
  }
  const BoxFinder tree(boxes);
  bool simple = true;
  for (std::size_t i = 0; i < n && simple; ++i) {
    context.check();
    tree.for_each_overlapping(boxes[i], [&](std::size_t j) {
      const bool neighbours = j == i || (i + 1) % n == j || (j + 1) % n == i;
      if (simple && j > i && !neighbours) {
        simple = !meet(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n], touch);
      }
    });
  }
  return simple;
}

double penetration(std::span<const Vec2> a, std::span<const Vec2> b) {
  double depth = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec2 origin = a[i];
      const Vec2 side = a[i + 1 < a.size() ? i + 1 : 0] - origin;
      const double size = length(side);
      if (!(size > 0.0)) {
        continue;
      }
      const Vec2 outward{side.y / size, -side.x / size};
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec2 corner : b) {
        nearest = std::min(nearest, dot(corner - origin, outward));
      }
      depth = std::min(depth, -nearest);
      if (depth <= 0.0) {
        return 0.0;
      }
    }
  }
  return std::isfinite(depth) ? depth : 0.0;
}

}  // namespace ridgecraft::verify
