// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of the plane that keep lengths and orientation: a turn, then a shift.
#pragma once

#include "base/vector.hpp"

namespace ridgecraft::unfold {

/// p goes to (cosine x - sine y + shift.x, sine x + cosine y + shift.y).
struct Rigid {
  double cosine = 1.0;
  double sine = 0.0;
  Vec2 shift;

  [[nodiscard]] constexpr Vec2 turn(Vec2 p) const {
    return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  }
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

}  // namespace ridgecraft::unfold
