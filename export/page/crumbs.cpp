// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/crumbs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "export/page/segment2.hpp"

namespace ridgecraft::paper {
namespace {

double distance_to(const Segment2& line, Vec2 p) {
  const Vec2 d = line.b - line.a;
  const double size = dot(d, d);
  const double at = size > 0.0 ? std::clamp(dot(p - line.a, d) / size, 0.0, 1.0) : 0.0;
  return length(p - line.a - at * d);
}

}  // namespace

std::vector<Vec2> without_crumbs(const std::vector<Vec2>& points, bool closed) {
  const std::size_t least = closed ? 3 : 2;
  std::vector<Vec2> kept;
  std::vector<Vec2> gone;  // since the last corner that was kept
  std::size_t left = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = !closed && (i == 0 || i + 1 == points.size());
    const Vec2 p = points[i];
    const Vec2 next = points[(i + 1) % points.size()];
    bool drop = !end && !kept.empty() && left > least &&
                std::min(length(p - kept.back()), length(next - p)) < near_corners_mm;
    if (drop) {
      const Segment2 line{kept.back(), next};
      drop = distance_to(line, p) < same_line_mm &&
             std::ranges::all_of(gone, [&](Vec2 q) { return distance_to(line, q) < same_line_mm; });
    }
    if (drop) {
      gone.push_back(p);
      --left;
    } else {
      kept.push_back(p);
      gone.clear();
    }
  }
  return kept;
}

}  // namespace ridgecraft::paper
