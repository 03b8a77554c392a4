// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/fold_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double end_mm = 4.0;
constexpr double shortest_mm = 0.5;
constexpr double clear_mm = 0.5;  ///< of what is cut beyond
constexpr double on_outline_mm = 0.05;
constexpr double probe_mm = 0.2;
constexpr double beside_mm = 0.3;  ///< nothing is cut so near along the line
constexpr double steepest_beside =
    0.4;  ///< sine of the angle: cuts that leave the line's begin so are beside it

}  // namespace

FoldEnds::FoldEnds(const Drawing& page) : sheet_(page.size) {
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
  const Vec2 last = end + std::min(room - clear_mm, room_on_sheet(end, away)) * away;
  if (!at_outline || dot(last - first, away) < shortest_mm || inside(loops_, end + probe_mm * away) ||
      inside(loops_, 0.5 * (first + last)) || is_beside_cut(end + probe_mm * away, end, kerf_mm) ||
      is_beside_cut(0.5 * (first + last), end, kerf_mm) || is_beside_cut(last, end, kerf_mm)) {
    return std::nullopt;
  }
  return std::vector<Vec2>{first, last};
}

double FoldEnds::room_on_sheet(Vec2 end, Vec2 away) const {
  const auto room = [](double at, double step, double size) {
    return step > 0.0 ? (size - at) / step : step < 0.0 ? at / -step : end_mm;
  };
  return std::min(room(end.x, away.x, sheet_.x), room(end.y, away.y, sheet_.y));
}

bool FoldEnds::is_beside_cut(Vec2 p, Vec2 end, double kerf_mm) const {
  const double clear = std::min(beside_mm + 0.5 * kerf_mm, steepest_beside * length(p - end));
  return std::ranges::any_of(sides_, [&](const Side& s) { return distance_to_segment(p, s.a, s.b) < clear; });
}

}  // namespace ridgecraft::export_
