// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

Isometry Isometry::inverse() const {
  const auto& [x, y, z] = motion.rows;
  Isometry result;
  result.mirrors = mirrors;
  result.motion.rows = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
  result.motion.shift = -result.motion.turn(motion.shift);
  return result;
}

Isometry operator*(const Isometry& a, const Isometry& b) {
  return {a.motion * b.motion, a.mirrors != b.mirrors};
}

Isometry mirroring(const MirrorPlane& plane) {
  const Vec3 n = plane.normal;
  Isometry result;
  result.mirrors = true;
  result.motion.rows = {Vec3{1.0, 0.0, 0.0} - 2.0 * n.x * n, Vec3{0.0, 1.0, 0.0} - 2.0 * n.y * n,
                        Vec3{0.0, 0.0, 1.0} - 2.0 * n.z * n};
  result.motion.shift = 2.0 * plane.offset * n;
  return result;
}

}  // namespace ridgecraft::prepare
