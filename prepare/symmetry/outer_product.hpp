// SPDX-License-Identifier: GPL-3.0-or-later
// Private to prepare/symmetry/, for .cpp files only.
#pragma once

#include <Eigen/Core>

#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// a b^T.
[[nodiscard]] inline Eigen::Matrix3d outer_product(Vec3 a, Vec3 b) {
  return Eigen::Vector3d(a.x, a.y, a.z) * Eigen::RowVector3d(b.x, b.y, b.z);
}

}  // namespace ridgecraft::prepare
