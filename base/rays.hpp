// SPDX-License-Identifier: GPL-3.0-or-later
// What a straight look meets: boxes and triangles on the way from a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/elementary.hpp"
#include "base/vector.hpp"

namespace ridgecraft {

/// Whether the way from a point to from + way comes into the box, its border included.
[[nodiscard]] inline bool comes_near(Vec3 from, Vec3 way, const Box3& box) {
  double enters = 0.0;
  double leaves = 1.0;
  const auto clip = [&](double start, double step, double low, double high) {
    if (step == 0.0) {
      leaves = start < low || start > high ? -1.0 : leaves;
      return;
    }
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  };
  clip(from.x, way.x, box.low.x, box.high.x);
  clip(from.y, way.y, box.low.y, box.high.y);
  clip(from.z, way.z, box.low.z, box.high.z);
  return enters <= leaves + 1e-9;
}

/// Where a ray meets a triangle from either side: at from + result * way, result > 0; infinity where it
/// doesn't. Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
[[nodiscard]] inline double meets_at(Vec3 from, Vec3 way, const std::array<Vec3, 3>& t) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const Vec3 u = t[1] - t[0];
  const Vec3 v = t[2] - t[0];
  const Vec3 p = cross(way, v);
  const double determinant = dot(u, p);
  if (determinant == 0.0) {
    return nowhere;
  }
  const Vec3 s = from - t[0];
  const double a = dot(s, p) / determinant;
  const Vec3 q = cross(s, u);
  const double b = dot(way, q) / determinant;
  const double at = dot(v, q) / determinant;
  return a >= 0.0 && b >= 0.0 && a + b <= 1.0 && at > 0.0 ? at : nowhere;
}

/// Direction i of `count` that are even over the sphere and along no axis: unit vectors (Gonzalez:
/// Measurement of areas on a sphere, 2010).
[[nodiscard]] inline Vec3 even_direction(int i, int count) {
  constexpr double golden_angle = 2.399963229728653;
  const double z = 1.0 - (2.0 * i + 1.0) / count;
  const double angle = 0.4 + i * golden_angle;
  const double r = std::sqrt(1.0 - z * z);
  return {r * elementary::cos(angle), r * elementary::sin(angle), z};
}

}  // namespace ridgecraft
