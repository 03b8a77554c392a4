// SPDX-License-Identifier: GPL-3.0-or-later
// Convex solids cut out of a block by planes, as a gem is cut, and a star that grows from one.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "samples/samples.hpp"

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

// A mailing box as it is cut from one sheet: half open, with its lid, tuck and dust flaps. A surface with a
// border.

namespace {

/// A flap along the edge from a to b, seen from outside with a on the left.
struct Flap {
  Vec3 a, b;
  Vec3 out;            ///< its direction
  double depth = 0.0;  ///< its length
  double taper = 0.0;  ///< by how much its free end is narrower on both sides
  double bevel = 0.0;  ///< by how much its free corners are cut off
};

void add(Shape& shape, const Flap& flap, Index material) {
  const Vec3 along = normalized(flap.b - flap.a);
  const Vec3 way_a = flap.depth * flap.out + flap.taper * along;
  const Vec3 way_b = flap.depth * flap.out - flap.taper * along;
  const double share = 1.0 - flap.bevel / flap.depth;
  shape.face({flap.a, flap.b, flap.b + share * way_b, flap.b + way_b - flap.bevel * along,
              flap.a + way_a + flap.bevel * along, flap.a + share * way_a},
             material);
}

/// A window frame: the panel keeps its border, and what was inside goes.
void frame(Shape& shape, Index panel, const Box2& window, Index material, Index inside) {
  shape.raise(panel, patch(shape.ring(panel), window.low, window.high), material);
  shape.set_material(panel, inside);
}

}  // namespace

Shape packaging_box() {
  Shape shape;
  const Index card = shape.material("card", {0.78, 0.62, 0.43});
  const Index flaps = shape.material("flaps", {0.86, 0.72, 0.54});
  const Index label = shape.material("label", {0.96, 0.95, 0.92});
  constexpr double w = 60, d = 40, h = 42;  // half width, half depth, height
  const Vec3 a{-w, -d, 0}, b{w, -d, 0}, c{w, d, 0}, e{-w, d, 0};
  const Vec3 up{0, 0, h};
  shape.face({a, e, c, b}, card);
  const Index front = shape.face({a, b, b + up, a + up}, card);
  const Index right = shape.face({b, c, c + up, b + up}, card);
  shape.face({c, e, e + up, c + up}, card);
  const Index left = shape.face({e, a, a + up, e + up}, card);
  frame(shape, front, {{0.2, 0.25}, {0.8, 0.75}}, card, label);
  frame(shape, right, {{0.3, 0.3}, {0.7, 0.7}}, card, label);
  frame(shape, left, {{0.3, 0.3}, {0.7, 0.7}}, card, label);

  const auto leaning = [](Vec3 outward, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return std::cos(angle) * outward + Vec3{0, 0, std::sin(angle)};
  };
  // Dust flaps lean outwards, left and right, and in front.
  add(shape, {b + up, c + up, leaning({1, 0, 0}, 35), 34, 5, 9}, flaps);
  add(shape, {e + up, a + up, leaning({-1, 0, 0}, 35), 34, 5, 9}, flaps);
  add(shape, {a + up, b + up, leaning({0, -1, 0}, 60), 18, 8, 7}, flaps);
  // The lid stands open behind, the sides of the lid and its tuck are bent towards the box.
  const Vec3 lid_out = leaning({0, 1, 0}, 62);
  const Vec3 lid_a = c + up, lid_b = e + up;
  const Vec3 far_a = lid_a + 2 * d * lid_out, far_b = lid_b + 2 * d * lid_out;
  const Index lid = shape.face({lid_a, lid_b, far_b, far_a}, card);
  frame(shape, lid, {{0.15, 0.2}, {0.85, 0.8}}, card, label);
  const Vec3 inward = normalized(cross({1, 0, 0}, lid_out));  // what the box sees of its lid
  add(shape, {far_a, far_b, normalized(lid_out + 1.2 * inward), 26, 6, 10}, flaps);
  add(shape, {far_b, lid_b, normalized(Vec3{-1, 0, 0} + 1.2 * inward), 22, 8, 8}, flaps);
  add(shape, {lid_a, far_a, normalized(Vec3{1, 0, 0} + 1.2 * inward), 22, 8, 8}, flaps);
  shape.finish();
  return shape;
}

std::span<const Sample> all() {
  static constexpr std::array samples = {Sample{"whale.obj", whale},
                                         Sample{"fish.obj", fish},
                                         Sample{"dinosaur.obj", dinosaur},
                                         Sample{"fox_head.obj", fox_head},
                                         Sample{"penguin.obj", penguin},
                                         Sample{"house.obj", house},
                                         Sample{"lighthouse.obj", lighthouse},
                                         Sample{"rocket.obj", rocket},
                                         Sample{"mug.obj", mug},
                                         Sample{"vase.ply", vase},
                                         Sample{"chess_rook.obj", chess_rook},
                                         Sample{"torus.off", torus},
                                         Sample{"heart.obj", heart},
                                         Sample{"gem.stl", gem},
                                         Sample{"star.obj", star},
                                         Sample{"packaging_box.obj", packaging_box, false}};
  return samples;
}

}  // namespace ridgecraft::samples
