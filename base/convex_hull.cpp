// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/convex_hull.hpp"

#include <algorithm>

namespace ridgecraft {

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) {
    return points;
  }
  std::vector<Vec2> hull;
  monotone_chain(
      points, [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - b); }, hull);
  return hull;
}

}  // namespace ridgecraft
