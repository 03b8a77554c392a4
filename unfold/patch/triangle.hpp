// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap of two triangles of the plane as a depth: the shortest translation that separates them.
//
// Source: the separating axis theorem for convex polygons (S. Gottschalk, M. Lin, D. Manocha, "OBBTree",
// SIGGRAPH 1996, section 5, in the plane); the greatest of the signed separations over all edge normals is
// minus the depth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vector.hpp"

namespace ridgecraft::unfold {

/// Corners counterclockwise. Triangles without area are allowed: they are segments or points.
using Triangle = std::array<Vec2, 3>;

/// Of a counterclockwise triangle, in the corners' unit squared.
[[nodiscard]] constexpr double area_of(const Triangle& t) {
  return 0.5 * cross(t[1] - t[0], t[2] - t[0]);
}

/// The greatest signed separation of a and b over the normals of a's edges: for each edge the distance from
/// a's farthest point along its outward normal to b's nearest. Edges without length have no normal and are
/// passed over.
[[nodiscard]] inline double separation(const Triangle& a, const Triangle& b) {
  double best = -INFINITY;
  for (unsigned k = 0; k < 3; ++k) {
    const Vec2 p = a[k];
    const Vec2 along = a[(k + 1) % 3] - p;
    const double size = length(along);
    if (!(size > 0.0)) {
      continue;
    }
    const Vec2 out{along.y / size, -along.x / size};
    const double nearest = std::min(dot(out, b[0] - p), std::min(dot(out, b[1] - p), dot(out, b[2] - p)));
    // The third corner lies on the inner side but for rounding; counting it keeps the bound where the edge is
    // so short that its direction means nothing.
    best = std::max(best, nearest - std::max(0.0, dot(out, a[(k + 2) % 3] - p)));
  }
  return best;
}

/// Penetration depth, in the unit of the corners: the length of the shortest translation that leaves the
/// interiors disjoint; 0 where the triangles touch, negative where they are apart (then it is minus a lower
/// bound of their distance). No case is special: neighbours along an edge, corner to corner, contained and
/// equal triangles all get their true depth.
///
/// Error: with corners that are exact and at most C away from the origin the result is off by less than 2^-49
/// C, because each separation is one scalar product of differences, and any unit vector, however wrong its
/// direction, is an axis that proves the separation measured along it. In a net the corners themselves carry
/// the error of the chain of folds, near 1e-15 of the net's size for thousands of faces.
[[nodiscard]] inline double penetration(const Triangle& a, const Triangle& b) {
  return -std::max(separation(a, b), separation(b, a));
}

/// penetration(a, b) > tolerance, but stops at the first axis that tells. A negative tolerance asks for a
/// clearance of that size between the triangles, measured along edge normals (never more than their
/// distance).
[[nodiscard]] inline bool overlap(const Triangle& a, const Triangle& b, double tolerance) {
  const double squared = tolerance * tolerance;
  const auto apart = [tolerance, squared](const Triangle& s, const Triangle& t) {
    for (unsigned k = 0; k < 3; ++k) {
      const Vec2 p = s[k];
      const Vec2 along = s[k == 2 ? 0 : k + 1] - p;
      // Depths of t's corners inside the edge, times its length.
      const double d0 = cross(along, t[0] - p);
      const double d1 = cross(along, t[1] - p);
      const double d2 = cross(along, t[2] - p);
      const double deeper = d0 > d1 ? d0 : d1;
      const double deepest = deeper > d2 ? deeper : d2;
      const double size_squared = dot(along, along);
      // Most axes fail at once, without a square root.
      if (deepest > 0.0 && deepest * deepest > squared * size_squared) {
        continue;
      }
      const double own = cross(along, s[k == 0 ? 2 : k - 1] - p);
      if (size_squared > 0.0 && deepest - (own < 0.0 ? own : 0.0) <= tolerance * std::sqrt(size_squared)) {
        return true;
      }
    }
    return false;
  };
  return !(apart(a, b) || apart(b, a));
}

}  // namespace ridgecraft::unfold
