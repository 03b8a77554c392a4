// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/pages/line_set.hpp"

#include <algorithm>
#include <cmath>

#include "base/segment.hpp"

namespace ridgecraft::verify {
namespace {

/// Stretches as short as that are rounding, mm.
constexpr double hair_mm = 1e-6;

Box2 box_around(const Segment& s, double reach) {
  const Vec2 margin{reach, reach};
  return {Vec2{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)} - margin,
          Vec2{std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)} + margin};
}

std::vector<Box2> boxes_of(const std::vector<Segment>& lines) {
  std::vector<Box2> boxes;
  boxes.reserve(lines.size());
  for (const Segment& line : lines) {
    boxes.push_back(box_around(line, 0.0));
  }
  return boxes;
}

/// A stretch of a segment, as distances from its start.
struct Stretch {
  double from = INFINITY;
  double to = -INFINITY;

  /// The smallest stretch that holds both.
  void unite(const Stretch& other) {
    if (other.from <= other.to) {
      from = std::min(from, other.from);
      to = std::max(to, other.to);
    }
  }
};

/// Where low <= offset + slope u <= high.
Stretch between(double offset, double slope, double low, double high) {
  if (slope == 0.0) {
    return offset >= low && offset <= high ? Stretch{-INFINITY, INFINITY} : Stretch{};
  }
  const double one = (low - offset) / slope;
  const double two = (high - offset) / slope;
  return {std::min(one, two), std::max(one, two)};
}

Stretch both(const Stretch& a, const Stretch& b) {
  return {std::max(a.from, b.from), std::min(a.to, b.to)};
}

/// Where the line from `start` along the unit vector `along` is within the radius of a point.
Stretch near_point(Vec2 start, Vec2 along, Vec2 p, double radius) {
  const double foot = dot(p - start, along);
  const double height = cross(along, p - start);
  const double square = radius * radius - height * height;
  return square >= 0.0 ? Stretch{foot - std::sqrt(square), foot + std::sqrt(square)} : Stretch{};
}

/// Where it is within the radius of a segment. What is that near to a segment is convex, so it is one
/// stretch: that in the band beside the segment and those in the discs around its ends, together.
Stretch near_segment(Vec2 start, Vec2 along, const Segment& s, double radius) {
  Stretch result = near_point(start, along, s.a, radius);
  result.unite(near_point(start, along, s.b, radius));
  const double size = s.length();
  if (size > 0.0) {
    const Vec2 way = (s.b - s.a) / size;
    result.unite(both(between(cross(way, start - s.a), cross(way, along), -radius, radius),
                      between(dot(way, start - s.a), dot(way, along), 0.0, size)));
  }
  return result;
}

}  // namespace

double distance(Vec2 p, const Segment& s) {
  return distance_to_segment(p, s.a, s.b);
}

LineSet::LineSet(std::vector<Segment> lines) : lines_(std::move(lines)), tree_(boxes_of(lines_)) {}

std::optional<Bare> LineSet::bare(const Segment& segment, double tolerance) const {
  const double size = segment.length();
  if (!(size > hair_mm)) {
    return distance_to(segment.a, tolerance) ? std::nullopt : std::optional(Bare{0.0, segment.a});
  }
  const Vec2 along = (segment.b - segment.a) / size;
  std::vector<Stretch> near;
  tree_.for_each_overlapping(box_around(segment, tolerance), [&](std::size_t i) {
    const Stretch stretch = near_segment(segment.a, along, lines_[i], tolerance);
    if (stretch.from <= stretch.to) {
      near.push_back(stretch);
    }
  });
  std::sort(near.begin(), near.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  near.push_back({size, size});
  std::optional<Bare> result;
  double at = 0.0;
  for (const Stretch& stretch : near) {
    if (const double gap = std::min(stretch.from, size) - at; gap > hair_mm) {
      if (!result) {
        result = Bare{0.0, segment.a + (at + 0.5 * gap) * along};
      }
      result->length += gap;
    }
    at = std::max(at, stretch.to);
  }
  return result;
}

std::optional<double> LineSet::distance_to(Vec2 p, double reach) const {
  double best = INFINITY;
  tree_.for_each_overlapping(box_around({p, p}, reach),
                             [&](std::size_t i) { best = std::min(best, verify::distance(p, lines_[i])); });
  return best <= reach ? std::optional(best) : std::nullopt;
}

}  // namespace ridgecraft::verify
