// SPDX-License-Identifier: GPL-3.0-or-later
// How large a triangle looks from a point: by the sum over a closed surface it winds around the point or not.
#pragma once

#include "base/elementary.hpp"
#include "base/vector.hpp"

namespace ridgecraft {

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

}  // namespace ridgecraft
