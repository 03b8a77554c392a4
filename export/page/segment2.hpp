// SPDX-License-Identifier: GPL-3.0-or-later
// A straight line between two points of the page, and where two of them lie on each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

struct Segment2 {
  Vec2 a;
  Vec2 b;
};

/// Lines nearer than this to each other are one line on paper, mm: a twentieth of a pen's width. A stretch
/// along which two lines lie so is drawn once.
inline constexpr double same_line_mm = 0.0105;
/// Shorter common stretches are a crossing or a shared end, mm.
inline constexpr double shortest_common_mm = 0.015;

/// A stretch of a segment: distances from its point a, mm.
struct Stretch {
  double from = 0.0;
  double to = 0.0;
};

/// The stretch of `base` along which `other` lies on it, everywhere within same_line_mm and over more than
/// shortest_common_mm; nothing if there is none. Where two lines open like scissors, the stretch ends where
/// they are same_line_mm apart.
[[nodiscard]] inline std::optional<Stretch> common_stretch(const Segment2& base, const Segment2& other) {
  const double size = length(base.b - base.a);
  if (!(size > 0.0)) {
    return std::nullopt;
  }
  const Vec2 along = (base.b - base.a) / size;
  double t0 = dot(other.a - base.a, along);
  double t1 = dot(other.b - base.a, along);
  double h0 = cross(along, other.a - base.a);
  double h1 = cross(along, other.b - base.a);
  if (t0 > t1) {
    std::swap(t0, t1);
    std::swap(h0, h1);
  }
  const double slope = t1 > t0 ? (h1 - h0) / (t1 - t0) : 0.0;
  double from = std::max(0.0, t0);
  double to = std::min(size, t1);
  if (std::abs(slope) > 0.0) {  // |h0 + slope (t - t0)| <= same_line_mm
    const double one = t0 + (same_line_mm - h0) / slope;
    const double two = t0 + (-same_line_mm - h0) / slope;
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  } else if (std::abs(h0) > same_line_mm) {
    return std::nullopt;
  }
  return to - from > shortest_common_mm ? std::optional<Stretch>({from, to}) : std::nullopt;
}

/// Whether two segments have a point in common. Exact enough for keeping a text clear of a line.
[[nodiscard]] inline bool cross_each_other(const Segment2& s, const Segment2& t) {
  const double a = cross(s.b - s.a, t.a - s.a);
  const double b = cross(s.b - s.a, t.b - s.a);
  const double c = cross(t.b - t.a, s.a - t.a);
  const double d = cross(t.b - t.a, s.b - t.a);
  return ((a > 0.0) != (b > 0.0)) && ((c > 0.0) != (d > 0.0));
}

}  // namespace ridgecraft::export_
