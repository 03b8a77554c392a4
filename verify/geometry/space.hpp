// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of space, and surfaces in it: how nets are folded and laid on the model, the nearest point of a
// surface, and what a surface goes around.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/boxes.hpp"
#include "base/vector.hpp"

namespace ridgecraft::verify {

// Turns and shifts of space: how nets are folded, and how a folded piece is laid on the model.

/// A turn as a unit quaternion w + xi + yj + zk.
struct Turn {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  /// By an angle in radians about a direction of length 1, counterclockwise seen from its tip.
  [[nodiscard]] static Turn about(Vec3 direction, double angle);
  [[nodiscard]] Vec3 operator()(Vec3 p) const;
  /// First b, then a; kept at length 1.
  friend Turn operator*(const Turn& a, const Turn& b);
};

/// p goes to turn(p) + shift.
struct Motion {
  Turn turn;
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
};

/// The motion without mirroring that lays `from` on `to` with the least sum of squared distances (Horn 1987:
/// the turn is the eigenvector to the largest eigenvalue of a symmetric 4 by 4 matrix). As many points in
/// both, at least one.
[[nodiscard]] Motion best_motion(std::span<const Vec3> from, std::span<const Vec3> to);

// The nearest point of a surface.

using Triangle3 = std::array<Vec3, 3>;

/// The point of a triangle, which may be without area, that is nearest to p.
[[nodiscard]] Vec3 nearest_on(const Triangle3& triangle, Vec3 p);

/// Triangles in a tree of boxes. Built in O(n log n); a query takes about O(log n).
class SurfaceTree {
 public:
  /// At least one triangle.
  explicit SurfaceTree(const std::vector<Triangle3>& triangles);

  /// A nearest point and the triangle that it lies on.
  struct Place {
    Vec3 point;
    std::uint32_t triangle = 0;
  };
  /// The nearest point of the surface, of the first triangle in triangles() where several have it as near on
  /// the way of the search (base/boxes.hpp: one way for one list); as soon as one is found that isn't
  /// farther than `enough`, that one will do. Looks at the triangle of `guess` first: that of a point nearby
  /// is often the one.
  [[nodiscard]] Place nearest(Vec3 p, double enough, const Place& guess) const;
  [[nodiscard]] const std::vector<Triangle3>& triangles() const { return triangles_; }

 private:
  BoxTree<Box3> tree_;
  std::vector<Triangle3> triangles_;  ///< in the order of the leaves
};

// What a surface goes around, also where it is open.

/// How often the triangles go around a point: 1 inside a closed surface, 0 outside, about a half in a flat
/// opening (Jacobson, Kavan, Sorkine-Hornung: Robust inside-outside segmentation using generalized winding
/// numbers, 2013). O(n).
[[nodiscard]] double winding(const std::vector<Triangle3>& triangles, Vec3 p);

}  // namespace ridgecraft::verify
