// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/fold_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/polygon.hpp"
#include "base/segment.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double end_mm = 4.0;
constexpr double shortest_mm = 0.5;
constexpr double clear_mm = 0.5;  ///< of what is cut beyond
constexpr double on_outline_mm = 0.05;
constexpr double probe_mm = 0.2;

}  // namespace

FoldEnds::FoldEnds(const Drawing& page) {
  for (const Group& group : page.groups) {
    for (const Line& line : group.lines) {
      if (line.layer == Layer::cut) {
        const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
        for (std::size_t i = 0; i < count; ++i) {
          sides_.push_back({line.points[i], line.points[(i + 1) % line.points.size()]});
        }
        if (line.closed) {
          loops_.push_back(line.points);
        }
      }
    }
  }
}

std::optional<std::vector<Vec2>> FoldEnds::beyond(Vec2 end, Vec2 from, double kerf_mm) const {
  const Vec2 away = (end - from) / length(end - from);
  double room = end_mm + clear_mm;
  bool at_outline = false;
  for (const auto& [a, b] : sides_) {
    at_outline = at_outline || distance_to_segment(end, a, b) < on_outline_mm;
    const double turn = cross(away, b - a);
    if (std::abs(turn) > 0.0) {
      const double at = cross(a - end, b - a) / turn;
      const double along = cross(a - end, away) / turn;
      if (at > probe_mm && along >= 0.0 && along <= 1.0) {
        room = std::min(room, at);
      }
    }
  }
  const Vec2 first = end + (0.5 * kerf_mm) * away;
  const Vec2 last = end + (room - clear_mm) * away;
  if (!at_outline || dot(last - first, away) < shortest_mm || inside(loops_, end + probe_mm * away) ||
      inside(loops_, 0.5 * (first + last))) {
    return std::nullopt;
  }
  return std::vector<Vec2>{first, last};
}

}  // namespace ridgecraft::paper
