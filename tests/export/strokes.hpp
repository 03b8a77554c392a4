// SPDX-License-Identifier: GPL-3.0-or-later
// How near strokes of texts and lines come to each other, for tests of what is drawn.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::test {

struct Stroke {
  Vec2 a;
  Vec2 b;
};

/// Distance of two segments by sampling one of them densely: slow, and nobody's idea of a clever method.
[[nodiscard]] inline double distance(const Stroke& s, const Stroke& t) {
  const auto to_segment = [](Vec2 p, const Stroke& line) {
    const Vec2 d = line.b - line.a;
    const double size = dot(d, d);
    const double at = size > 0.0 ? std::clamp(dot(p - line.a, d) / size, 0.0, 1.0) : 0.0;
    return length(p - line.a - at * d);
  };
  constexpr int steps = 12;
  double least = INFINITY;
  for (int i = 0; i <= steps; ++i) {
    least = std::min(least, to_segment(s.a + (s.b - s.a) * (i / static_cast<double>(steps)), t));
  }
  return least;
}

[[nodiscard]] inline std::vector<Stroke> strokes_of(const std::vector<std::vector<Vec2>>& lines) {
  std::vector<Stroke> strokes;
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      strokes.push_back({line[i - 1], line[i]});
    }
  }
  return strokes;
}

[[nodiscard]] inline std::vector<Stroke> strokes_of(const export_::Line& line) {
  std::vector<Vec2> points = line.points;
  if (line.closed) {
    points.push_back(points.front());
  }
  return strokes_of(std::vector<std::vector<Vec2>>{points});
}

[[nodiscard]] inline Box2 bounds(const std::vector<Stroke>& strokes) {
  Box2 box;
  for (const Stroke& s : strokes) {
    box.add(s.a);
    box.add(s.b);
  }
  return box;
}

[[nodiscard]] inline bool far_apart(const Box2& a, const Box2& b) {
  return a.low.x > b.high.x + 1.0 || b.low.x > a.high.x + 1.0 || a.low.y > b.high.y + 1.0 ||
         b.low.y > a.high.y + 1.0;
}

[[nodiscard]] inline double nearest(const std::vector<Stroke>& a, const std::vector<Stroke>& b) {
  double best = INFINITY;
  for (const Stroke& s : a) {
    for (const Stroke& t : b) {
      best = std::min(best, distance(s, t));
    }
  }
  return best;
}

}  // namespace ridgecraft::test
