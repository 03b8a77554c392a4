// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of space that keep lengths, mirrored ones among them.
#pragma once

#include "base/geometry.hpp"
#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// The plane of the points p with dot(p, normal) == offset. The normal has length 1, and its first component
/// that isn't 0 is positive, so one plane has one value.
struct MirrorPlane {
  Vec3 normal{1.0, 0.0, 0.0};
  double offset = 0.0;

  /// Signed distance of a point from the plane.
  [[nodiscard]] double height(Vec3 p) const { return dot(p, normal) - offset; }
  [[nodiscard]] Vec3 image(Vec3 p) const { return p - 2.0 * height(p) * normal; }
  [[nodiscard]] Vec3 foot(Vec3 p) const { return p - height(p) * normal; }
};

/// A motion, or a motion after mirroring: then the rows of its matrix have the determinant -1.
struct Isometry {
  Motion motion;
  bool mirrors = false;

  [[nodiscard]] Vec3 turn(Vec3 v) const { return motion.turn(v); }
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return motion(p); }
  [[nodiscard]] Isometry inverse() const;
};

/// First b, then a.
[[nodiscard]] Isometry operator*(const Isometry& a, const Isometry& b);

[[nodiscard]] Isometry mirroring(const MirrorPlane& plane);

}  // namespace ridgecraft::prepare
