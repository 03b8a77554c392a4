// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors for Eigen. For .cpp files of prepare/ only.
#pragma once

#include <Eigen/Core>

#include "base/vector.hpp"

namespace ridgecraft::prepare {

[[nodiscard]] inline Eigen::Vector3d to_eigen(Vec3 v) {
  return {v.x, v.y, v.z};
}
[[nodiscard]] inline Vec3 to_vec3(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// a b^T.
[[nodiscard]] inline Eigen::Matrix3d outer_product(Vec3 a, Vec3 b) {
  return to_eigen(a) * to_eigen(b).transpose();
}

}  // namespace ridgecraft::prepare
