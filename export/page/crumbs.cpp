// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/crumbs.hpp"

#include <algorithm>
#include <cstddef>

#include "base/geometry.hpp"
#include "export/page/segment2.hpp"

namespace ridgecraft::export_ {

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
      const auto on_line = [&](Vec2 q) { return distance_to_segment(q, kept.back(), next) < same_line_mm; };
      drop = on_line(p) && std::ranges::all_of(gone, on_line);
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

}  // namespace ridgecraft::export_
