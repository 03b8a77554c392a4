// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/winding.hpp"

#include <numbers>

#include "base/elementary.hpp"

namespace ridgecraft::verify {

double winding(const std::vector<Triangle3>& triangles, Vec3 p) {
  double angle = 0.0;
  for (const Triangle3& t : triangles) {
    // Van Oosterom, Strackee: The solid angle of a plane triangle, 1983.
    const Vec3 a = t[0] - p;
    const Vec3 b = t[1] - p;
    const Vec3 c = t[2] - p;
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    angle += 2.0 * elementary::atan2(dot(a, cross(b, c)),
                                     la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace ridgecraft::verify
