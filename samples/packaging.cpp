// SPDX-License-Identifier: GPL-3.0-or-later
// A mailing box as it is cut from one sheet: half open, with its lid, tuck and dust flaps. A surface with a
// border.
#include <cmath>
#include <numbers>

#include "samples/models.hpp"

namespace ridgecraft::samples {
namespace {

/// A flap along the edge from a to b, seen from outside with a on the left: `depth` long in the direction
/// `out`, its free corners cut off by `bevel`, and narrower there by `taper` on both sides.
Index flap(Shape& shape, Vec3 a, Vec3 b, Vec3 out, double depth, double taper, double bevel, Index material) {
  const Vec3 along = normalized(b - a);
  const Vec3 far_a = a + depth * out + taper * along;
  const Vec3 far_b = b + depth * out - taper * along;
  const Vec3 side_a = a + (1.0 - bevel / depth) * (depth * out + taper * along);
  const Vec3 side_b = b + (1.0 - bevel / depth) * (depth * out - taper * along);
  return shape.face({a, b, side_b, far_b - bevel * along, far_a + bevel * along, side_a}, material);
}

/// A window frame: the panel keeps its border, and what was inside goes.
void frame(Shape& shape, Index panel, Vec2 low, Vec2 high, Index material, Index inside) {
  shape.raise(panel, patch(shape.ring(panel), low, high), material);
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
  frame(shape, front, {0.2, 0.25}, {0.8, 0.75}, card, label);
  frame(shape, right, {0.3, 0.3}, {0.7, 0.7}, card, label);
  frame(shape, left, {0.3, 0.3}, {0.7, 0.7}, card, label);

  const auto leaning = [](Vec3 outward, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return std::cos(angle) * outward + Vec3{0, 0, std::sin(angle)};
  };
  // Dust flaps lean outwards, left and right, and in front.
  flap(shape, b + up, c + up, leaning({1, 0, 0}, 35), 34, 5, 9, flaps);
  flap(shape, e + up, a + up, leaning({-1, 0, 0}, 35), 34, 5, 9, flaps);
  flap(shape, a + up, b + up, leaning({0, -1, 0}, 60), 18, 8, 7, flaps);
  // The lid stands open behind, the sides of the lid and its tuck are bent towards the box.
  const Vec3 lid_out = leaning({0, 1, 0}, 62);
  const Vec3 lid_a = c + up, lid_b = e + up;
  const Vec3 far_a = lid_a + 2 * d * lid_out, far_b = lid_b + 2 * d * lid_out;
  const Index lid = shape.face({lid_a, lid_b, far_b, far_a}, card);
  frame(shape, lid, {0.15, 0.2}, {0.85, 0.8}, card, label);
  const Vec3 inward = normalized(cross({1, 0, 0}, lid_out));  // what the box sees of its lid
  flap(shape, far_a, far_b, normalized(lid_out + 1.2 * inward), 26, 6, 10, flaps);
  flap(shape, far_b, lid_b, normalized(Vec3{-1, 0, 0} + 1.2 * inward), 22, 8, 8, flaps);
  flap(shape, lid_a, far_a, normalized(Vec3{1, 0, 0} + 1.2 * inward), 22, 8, 8, flaps);
  shape.finish();
  return shape;
}

}  // namespace ridgecraft::samples
