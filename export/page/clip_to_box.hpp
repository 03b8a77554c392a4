// SPDX-License-Identifier: GPL-3.0-or-later
// What of points, lines and polygons lies within an upright rectangle.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"
#include "export/page/segment2.hpp"

namespace ridgecraft::export_ {

/// The stretch of a line in the rectangle; nothing where that is no more than a point.
[[nodiscard]] inline std::optional<Segment2> clipped(const Segment2& line, const Box2& box) {
  const Vec2 d = line.b - line.a;
  double from = 0.0;
  double to = 1.0;
  // `low` and `high`: of the rectangle, seen from the line's beginning.
  const auto cut = [&](double along, double low, double high) {
    if (along == 0.0) {
      return low <= 0.0 && high >= 0.0;
    }
    from = std::max(from, std::min(low / along, high / along));
    to = std::min(to, std::max(low / along, high / along));
    return from < to;
  };
  if (!cut(d.x, box.low.x - line.a.x, box.high.x - line.a.x) ||
      !cut(d.y, box.low.y - line.a.y, box.high.y - line.a.y)) {
    return std::nullopt;
  }
  return Segment2{line.a + from * d, line.a + to * d};
}

/// The part of a polygon in the rectangle, as part_where() leaves it: fewer than three corners where there is
/// none.
[[nodiscard]] inline std::vector<Vec2> clipped(std::vector<Vec2> polygon, const Box2& box) {
  polygon = part_where(polygon, [&](Vec2 p) { return p.x - box.low.x; });
  polygon = part_where(polygon, [&](Vec2 p) { return box.high.x - p.x; });
  polygon = part_where(polygon, [&](Vec2 p) { return p.y - box.low.y; });
  return part_where(polygon, [&](Vec2 p) { return box.high.y - p.y; });
}

}  // namespace ridgecraft::export_
