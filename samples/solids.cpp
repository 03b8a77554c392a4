// SPDX-License-Identifier: GPL-3.0-or-later
// Convex solids cut out of a block by planes, as a gem is cut, and a star that grows from one.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "samples/models.hpp"

namespace ridgecraft::samples {
namespace {

using std::numbers::pi;

/// Keeps what is behind the plane: the points p with dot(normal, p) <= distance.
struct Plane {
  Vec3 normal;
  double distance;
};

/// A convex solid as the polygons of its sides.
using Sides = std::vector<Ring>;

Sides block(double half) {
  const Ring bottom =
      reversed({{-half, -half, -half}, {half, -half, -half}, {half, half, -half}, {-half, half, -half}});
  Sides sides;
  const Ring top = reversed(shifted(bottom, {0, 0, 2 * half}));
  sides.push_back(bottom);
  sides.push_back(top);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    sides.push_back(
        {bottom[next], bottom[k], bottom[k] + Vec3{0, 0, 2 * half}, bottom[next] + Vec3{0, 0, 2 * half}});
  }
  return sides;
}

/// Sorts corners of a new side counterclockwise about its normal, equal ones once.
Ring around(std::vector<Vec3> corners, Vec3 normal) {
  const Vec3 middle = mean(corners);
  const Vec3 right = normalized(cross(std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal));
  const Vec3 up = cross(normal, right);
  const auto angle = [&](Vec3 p) { return std::atan2(dot(p - middle, up), dot(p - middle, right)); };
  std::sort(corners.begin(), corners.end(), [&](Vec3 a, Vec3 b) { return angle(a) < angle(b); });
  const auto equal = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-9; };
  corners.erase(std::unique(corners.begin(), corners.end(), equal), corners.end());
  while (corners.size() > 1 && equal(corners.front(), corners.back())) {
    corners.pop_back();
  }
  return corners;
}

Sides cut(const Sides& sides, const Plane& plane) {
  constexpr double on_plane = 1e-9;
  Sides result;
  std::vector<Vec3> fresh;
  for (const Ring& side : sides) {
    Ring kept;
    for (std::size_t k = 0; k < side.size(); ++k) {
      const Vec3 a = side[k];
      const Vec3 b = side[(k + 1) % side.size()];
      const double above = dot(plane.normal, a) - plane.distance;
      const double next = dot(plane.normal, b) - plane.distance;
      if (above <= on_plane) {
        kept.push_back(a);
      }
      if (std::abs(above) <= on_plane) {
        fresh.push_back(a);
      } else if ((above < -on_plane && next > on_plane) || (above > on_plane && next < -on_plane)) {
        const Vec3 p = a + (above / (above - next)) * (b - a);
        kept.push_back(p);
        fresh.push_back(p);
      }
    }
    if (kept.size() >= 3) {
      result.push_back(kept);
    }
  }
  if (const Ring ring = around(fresh, plane.normal);
      ring.size() >= 3 && result.size() < sides.size() + fresh.size()) {
    const bool is_new = std::any_of(sides.begin(), sides.end(), [&](const Ring& side) {
      return std::any_of(side.begin(), side.end(),
                         [&](Vec3 p) { return dot(plane.normal, p) > plane.distance + on_plane; });
    });
    if (is_new) {
      result.push_back(ring);
    }
  }
  return result;
}

/// As many planes as `count`, equally spread around the z axis. Each goes through two points of the upright
/// half plane in its own direction, given as (distance from the axis, height), the lower one first.
void cut_around(Sides& sides, int count, double start, Vec2 low, Vec2 high) {
  const Vec2 outward = perpendicular(low - high) / length(low - high);
  for (int k = 0; k < count; ++k) {
    const double angle = start + 2.0 * pi * k / count;
    const Vec3 normal{outward.x * std::cos(angle), outward.x * std::sin(angle), outward.y};
    sides = cut(sides, {normal, dot(outward, low)});
  }
}

}  // namespace

Shape gem() {
  Shape shape;
  const Index stone = shape.material("stone", {0.45, 0.75, 0.85});
  Sides sides = block(100.0);
  // A brilliant: 16 sides of the girdle, 8 main facets above and below at every second corner of it, the
  // halves between mains and girdle, and the stars between mains and table. All are laid through the points
  // where they meet.
  constexpr double girdle = 50, belt = 4, table = 29, crown = 18, depth = 42, meet_above = 41,
                   meet_below = 17;
  const double corner = girdle / std::cos(pi / 16.0);
  const double main_side = std::cos(pi / 8.0);
  const double half_side = std::cos(pi / 16.0);
  const double height_above = belt + crown * (corner - meet_above * main_side) / (corner - table);
  const double height_below = -belt - depth * (corner - meet_below * main_side) / corner;
  cut_around(sides, 16, pi / 16.0, {girdle, -belt}, {girdle, belt});
  sides = cut(sides, {{0, 0, 1}, belt + crown});
  cut_around(sides, 8, 0.0, {corner, belt}, {table, belt + crown});
  cut_around(sides, 8, pi / 8.0, {meet_above, height_above}, {table * main_side, belt + crown});
  cut_around(sides, 16, pi / 16.0, {girdle, belt}, {meet_above * half_side, height_above});
  cut_around(sides, 8, 0.0, {0, -belt - depth}, {corner, -belt});
  cut_around(sides, 16, pi / 16.0, {meet_below * half_side, height_below}, {girdle, -belt});
  for (const Ring& side : sides) {
    shape.face(side, stone);
  }
  shape.finish();
  return shape;
}

Shape star() {
  Shape shape;
  const Index warm = shape.material("warm", {0.98, 0.82, 0.35});
  const Index bright = shape.material("bright", {0.99, 0.93, 0.68});
  // The rhombicuboctahedron: planes of a cube, of its edges and of its corners; a spike on each of its 26
  // sides.
  const double reach = 1.0 + std::sqrt(2.0);
  Sides sides = block(4.0);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int planes = std::abs(x) + std::abs(y) + std::abs(z);
        if (planes > 0) {
          const Vec3 normal = normalized(Vec3{1.0 * x, 1.0 * y, 1.0 * z});
          sides = cut(sides, {normal, planes == 3 ? (3.0 + std::sqrt(2.0)) / std::sqrt(3.0) : reach});
        }
      }
    }
  }
  for (const Ring& side : sides) {
    const Index face = shape.face(scaled(side, {}, 9.0), warm);
    const bool triangle = side.size() == 3;
    shape.raise_to_point(face, shape.centre(face) + (triangle ? 30.0 : 40.0) * shape.normal(face),
                         triangle ? bright : warm);
  }
  shape.finish();
  return shape;
}

}  // namespace ridgecraft::samples
