// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/gaps.hpp"

#include <algorithm>
#include <cmath>

#include "export/page/obstacles.hpp"

namespace ridgecraft::export_ {
namespace {

/// Between a text and a line that ends before it, mm.
constexpr double gap_mm = 0.4;
/// Shorter stretches are specks, mm.
constexpr double shortest_mm = 0.6;

/// The share of a line, from 0 to 1, that lies in a box; empty (from > to) where none does.
Stretch within(const Segment2& line, const TurnedBox& box) {
  Stretch inside{0.0, 1.0};
  const Vec2 d = line.b - line.a;
  for (const auto& [axis, half] :
       {std::pair(box.along, box.half_width), std::pair(perpendicular(box.along), box.half_height)}) {
    const double at = dot(line.a - box.centre, axis);
    const double step = dot(d, axis);
    if (std::abs(step) > 0.0) {
      inside.from = std::max(inside.from, std::min((-half - at) / step, (half - at) / step));
      inside.to = std::min(inside.to, std::max((-half - at) / step, (half - at) / step));
    } else if (std::abs(at) > half) {
      return {1.0, 0.0};
    }
  }
  return inside;
}

}  // namespace

std::vector<Segment2> beside_texts(const Segment2& line, const std::vector<Text>& texts) {
  std::vector<Stretch> covered;
  for (const Text& text : texts) {
    if (const Stretch inside = within(line, box_of(text).grown(gap_mm)); inside.from < inside.to) {
      covered.push_back(inside);
    }
  }
  std::ranges::sort(covered, {}, [](const Stretch& s) { return s.from; });
  covered.push_back({1.0, 1.0});
  std::vector<Segment2> parts;
  double at = 0.0;
  for (const Stretch& stretch : covered) {
    if ((stretch.from - at) * length(line.b - line.a) > shortest_mm) {
      parts.push_back({line.a + at * (line.b - line.a), line.a + stretch.from * (line.b - line.a)});
    }
    at = std::max(at, stretch.to);
  }
  return parts;
}

}  // namespace ridgecraft::export_
