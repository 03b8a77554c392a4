// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/flat_outline.hpp"

#include <algorithm>

#include "base/delaunay.hpp"

namespace ridgecraft::prepare {

std::vector<std::uint32_t> points_of(const std::vector<OutlineSide>& sides) {
  std::vector<std::uint32_t> points;
  for (const OutlineSide& side : sides) {
    points.push_back(side[0]);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_between(std::vector<OutlineSide> sides,
                                                                           const std::vector<Vec3>& places,
                                                                           const PlaneFrame& frame) {
  const std::vector<std::uint32_t> points = points_of(sides);
  std::vector<Vec2> flat;
  for (const std::uint32_t p : points) {
    flat.push_back(frame.flat(places[p]));
  }
  for (OutlineSide& side : sides) {
    for (std::uint32_t& p : side) {
      p = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
    }
  }
  auto triangles = triangulate_inside(flat, sides);
  if (triangles) {
    std::sort(triangles->begin(), triangles->end());
    for (auto& t : *triangles) {
      t = {points[t[0]], points[t[1]], points[t[2]]};
    }
  }
  return triangles;
}

}  // namespace ridgecraft::prepare
