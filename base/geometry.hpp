// SPDX-License-Identifier: GPL-3.0-or-later
// Plane and solid geometry in small: segments, polygons, convex hulls, coordinates in a plane, motions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <ranges>
#include <span>
#include <vector>

#include "base/elementary.hpp"
#include "base/vector.hpp"

namespace ridgecraft {

// Distances from straight segments, in the plane and in space.

/// The point of the segment from a to b that is nearest to p. `Point` is Vec2 or Vec3.
template <class Point>
[[nodiscard]] inline Point nearest_on_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double share = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return a + share * along;
}

template <class Point>
[[nodiscard]] inline double distance_to_segment(Point p, Point a, Point b) {
  return length(p - nearest_on_segment(p, a, b));
}

// Measures and parts of polygons and of lines of several stretches.

/// Twice the signed area of a closed polygon, positive when it runs counterclockwise; measured from the first
/// corner, so that a small polygon far from the origin keeps its digits.
[[nodiscard]] inline double doubled_area(std::span<const Vec2> polygon) {
  double sum = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}

/// Whether a point lies in what closed polygons bound, by the even-odd rule: holes are outside. Points on a
/// side are on either side of it. O(n).
[[nodiscard]] inline bool inside(std::span<const std::vector<Vec2>> loops, Vec2 p) {
  bool odd = false;
  for (const std::vector<Vec2>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
        odd = !odd;
      }
    }
  }
  return odd;
}

/// Of an open line through these points.
[[nodiscard]] inline double length_of(std::span<const Vec2> line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += length(line[i] - line[i - 1]);
  }
  return sum;
}

/// The part of a polygon where `height`, an affine function of the place, isn't negative; fewer than three
/// corners where it is negative everywhere. Convex polygons stay convex; parts of concave ones hang together
/// along the line of height 0. O(n).
template <class Point, class Height>
[[nodiscard]] std::vector<Point> part_where(const std::vector<Point>& polygon, Height height) {
  std::vector<Point> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point p = polygon[i];
    const Point q = polygon[(i + 1) % polygon.size()];
    const double at_p = height(p);
    const double at_q = height(q);
    if (at_p >= 0.0) {
      part.push_back(p);
    }
    if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) {
      part.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
  }
  return part;
}

// Convex hulls of points in the plane.

/// Corners of the hull, counterclockwise, of points in the order of x, then y; none at all where they are one
/// place. `turn(a, b, c)` is above 0 where c lies left of the line from a to b. `hull` is written over. O(n):
/// the monotone chain (A. Andrew, Information Processing Letters 9, 1979).
template <std::ranges::random_access_range Points, class Turn, class Point>
void monotone_chain(const Points& sorted, const Turn& turn, std::vector<Point>& hull) {
  hull.clear();
  if (std::ranges::empty(sorted)) {
    return;
  }
  const auto add = [&](const Point& p, std::size_t keep) {
    while (hull.size() >= keep + 2 && !(turn(hull[hull.size() - 2], hull.back(), p) > 0)) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Point& p : sorted) {
    add(p, 0);
  }
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) {
    add(sorted[i], lower);
  }
  hull.pop_back();
}

/// Corners counterclockwise, no three collinear but for rounding; of fewer than three different points, those
/// points. O(n log n).
[[nodiscard]] std::vector<Vec2> convex_hull(std::vector<Vec2> points);

// Coordinates within a plane of space.

/// Right-handed frame: counterclockwise seen from where the normal points to. Planes across an axis give
/// coordinates without any rounding.
class PlaneFrame {
 public:
  PlaneFrame(Vec3 origin, Vec3 normal) : origin_(origin) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    across_ = normalized(cross(axis, normal));
    up_ = cross(normal, across_);
  }
  /// The point of the plane with these coordinates.
  [[nodiscard]] Vec3 place(Vec2 p) const { return origin_ + p.x * across_ + p.y * up_; }
  [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p - origin_, across_), dot(p - origin_, up_)}; }

 private:
  Vec3 origin_;
  Vec3 across_;
  Vec3 up_;
};

// How large a triangle looks from a point: by the sum over a closed surface it winds around the point or not.

/// The solid angle of a triangle seen from the origin, steradians, in [-2 pi, 2 pi]; positive where its
/// corners run counterclockwise seen from outside, that is with the origin behind it. The sum over a closed,
/// outwards oriented surface is 4 pi inside and 0 outside. (A. van Oosterom, J. Strackee: The solid angle of
/// a plane triangle, 1983.)
[[nodiscard]] inline double solid_angle(Vec3 a, Vec3 b, Vec3 c) {
  const double la = length(a);
  const double lb = length(b);
  const double lc = length(c);
  return 2.0 * elementary::atan2(dot(a, cross(b, c)),
                                 la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

// Motions that keep lengths and orientation: a turn, then a shift. Rigid moves the plane, Motion moves space.

/// A turn of the plane about the origin, counterclockwise.
struct Turn {
  double cosine = 1.0;
  double sine = 0.0;

  [[nodiscard]] constexpr Vec2 operator()(Vec2 p) const {
    return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  }
};

/// p goes to (cosine x - sine y + shift.x, sine x + cosine y + shift.y).
struct Rigid {
  double cosine = 1.0;
  double sine = 0.0;
  Vec2 shift;

  [[nodiscard]] constexpr Vec2 turn(Vec2 p) const { return Turn{cosine, sine}(p); }
  [[nodiscard]] constexpr Vec2 operator()(Vec2 p) const { return turn(p) + shift; }

  [[nodiscard]] constexpr Rigid inverse() const {
    return {cosine, -sine, {-cosine * shift.x - sine * shift.y, sine * shift.x - cosine * shift.y}};
  }
};

/// First b, then a. The turn is brought back to length 1 by one Newton step: it is off by a few units in the
/// last place only, so one step is exact to rounding, and long chains of motions don't shrink or grow.
[[nodiscard]] constexpr Rigid operator*(const Rigid& a, const Rigid& b) {
  const double c = a.cosine * b.cosine - a.sine * b.sine;
  const double s = a.sine * b.cosine + a.cosine * b.sine;
  const double scale = 1.5 - 0.5 * (c * c + s * s);
  return {scale * c, scale * s, a(b.shift)};
}

/// A motion of space: rows of its turn, then its shift.
struct Motion {
  std::array<Vec3, 3> rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  Vec3 shift;

  [[nodiscard]] Vec3 turn(Vec3 p) const { return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)}; }
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }

  [[nodiscard]] Motion inverse() const {
    const auto& [x, y, z] = rows;
    Motion back;
    back.rows = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
    back.shift = -back.turn(shift);
    return back;
  }
};

/// First b, then a.
[[nodiscard]] inline Motion operator*(const Motion& a, const Motion& b) {
  Motion c;
  for (std::size_t i = 0; i < 3; ++i) {
    c.rows[i] = a.rows[i].x * b.rows[0] + a.rows[i].y * b.rows[1] + a.rows[i].z * b.rows[2];
  }
  c.shift = a(b.shift);
  return c;
}

/// Turns about a line in the plane z = 0 by an angle in radians (O. Rodrigues). The direction has length 1.
[[nodiscard]] inline Motion turn_about(Vec2 start, Vec2 direction, double angle) {
  const double c = elementary::cos(angle);
  const double s = elementary::sin(angle);
  const Vec2 d = direction;
  Motion turn;
  turn.rows = {Vec3{c + d.x * d.x * (1.0 - c), d.x * d.y * (1.0 - c), d.y * s},
               Vec3{d.x * d.y * (1.0 - c), c + d.y * d.y * (1.0 - c), -d.x * s}, Vec3{-d.y * s, d.x * s, c}};
  const Vec3 p{start.x, start.y, 0.0};
  turn.shift = p - turn.turn(p);
  return turn;
}

// Does it fit the sheet? The turn that brings a convex polygon into a rectangle.

/// A rectangle that may lie anywhere.
struct Rectangle {
  double width = 0.0;
  double height = 0.0;
};

/// The angle (radians, counterclockwise) by which a convex polygon is turned so that its extents along x and
/// y are at most the rectangle's width and height; none when there is none. Exact but for 1e-7: where any
/// angle fits, one fits at which an extent equals the rectangle's, or all do. O(m^2) for m corners up to 64,
/// O(m log m) beyond.
[[nodiscard]] std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Rectangle& rectangle);

}  // namespace ridgecraft
