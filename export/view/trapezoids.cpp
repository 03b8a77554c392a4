// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/trapezoids.hpp"

#include <algorithm>
#include <cmath>

#include <boost/polygon/polygon.hpp>

#include "base/polygon.hpp"

namespace ridgecraft::paper {
namespace planar = boost::polygon;

std::vector<std::vector<Vec2>> trapezoids(const std::vector<Vec2>& outline) {
  constexpr double grid_cells = 1e7;
  Box2 box;
  for (const Vec2 p : outline) {
    box.add(p);
  }
  if (box.empty()) {
    return {};
  }
  const double cell = std::max({box.size().x, box.size().y, 1e-300}) / grid_cells;
  std::vector<planar::point_data<int>> points;
  for (const Vec2 p : outline) {
    const Vec2 q = (p - box.low) / cell;
    points.emplace_back(static_cast<int>(std::lround(q.x)), static_cast<int>(std::lround(q.y)));
  }
  planar::polygon_data<int> polygon;
  polygon.set(points.begin(), points.end());
  planar::polygon_set_data<int> covered;
  covered.insert(polygon);
  std::vector<planar::polygon_data<int>> pieces;
  covered.get_trapezoids(pieces);
  std::vector<std::vector<Vec2>> result;
  for (const planar::polygon_data<int>& piece : pieces) {
    std::vector<Vec2>& corners = result.emplace_back();
    for (const auto& p : piece) {
      const Vec2 corner = box.low + cell * Vec2{static_cast<double>(p.x()), static_cast<double>(p.y())};
      if (corners.empty() || (corner != corners.front() && corner != corners.back())) {
        corners.push_back(corner);
      }
    }
    if (corners.size() < 3) {
      result.pop_back();
    } else if (doubled_area(corners) < 0.0) {
      std::reverse(corners.begin(), corners.end());
    }
  }
  return result;
}

}  // namespace ridgecraft::paper
