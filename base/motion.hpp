// SPDX-License-Identifier: GPL-3.0-or-later
// Motions that keep lengths and orientation: a turn, then a shift. Rigid moves the plane, Motion moves space.
#pragma once

#include <array>
#include <cstddef>

#include "base/elementary.hpp"
#include "base/vector.hpp"

namespace ridgecraft {

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

}  // namespace ridgecraft
