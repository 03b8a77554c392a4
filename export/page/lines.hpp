// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines of a page: where two of them lie on each other, what of them lies in a rectangle, folds as
// one line, and stretches that are too short to be meant: a knife would plunge and turn there.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// A straight line between two points of the page.
struct Segment2 {
  Vec2 a;
  Vec2 b;
};

/// The straight stretches of a line, the closing one last. O(points).
[[nodiscard]] inline std::vector<Segment2> segments_of(const Line& line) {
  std::vector<Segment2> segments;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    segments.push_back({line.points[i - 1], line.points[i]});
  }
  if (line.closed) {
    segments.push_back({line.points.back(), line.points.front()});
  }
  return segments;
}

/// Whether a box reaches out of another one nowhere.
[[nodiscard]] inline bool lies_within(const Box2& part, const Box2& whole) {
  return part.low.x >= whole.low.x && part.low.y >= whole.low.y && part.high.x <= whole.high.x &&
         part.high.y <= whole.high.y;
}

/// Ends of two edges of an outline that are one corner but for rounding, mm.
inline constexpr double same_corner_mm = 1e-6;

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

/// Whole lines that aren't longer are left out, mm: they aren't seen, and what they touch is drawn.
inline constexpr double crumb_mm = 0.02;
/// Corners nearer to each other become one where the line hardly changes by it, mm.
inline constexpr double near_corners_mm = 0.05;

/// A polygon, or an open line, without corners that are near the one before or behind: each that goes lies
/// within same_line_mm of the line that is left. At least three corners stay, of a line its
/// ends. O(n).
[[nodiscard]] std::vector<Vec2> without_crumbs(const std::vector<Vec2>& points, bool closed);

struct FoldSegment {
  Segment2 line;
  Fold fold = Fold::none;
};

/// Joins segments of one kind that go straight on at a common end. O(n log n).
[[nodiscard]] std::vector<FoldSegment> join_straight(const std::vector<FoldSegment>& folds);

/// Remembers what has been drawn, so that nothing is drawn upon it.
class DrawnLines {
 public:
  void add(const Segment2& line) { lines_.push_back(line); }
  /// The parts of a line that lie on nothing drawn so far within same_line_mm, from its start to its
  /// end.
  [[nodiscard]] std::vector<Segment2> free_parts(const Segment2& line) const;

 private:
  std::vector<Segment2> lines_;
};

}  // namespace ridgecraft::export_
