// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/area_frame.hpp"

#include <cstddef>

#include <Eigen/Eigenvalues>

#include "prepare/symmetry/outer_product.hpp"

namespace ridgecraft::prepare {

AreaFrame area_frame(const mesh::Surface& surface) {
  AreaFrame frame;
  double area = 0.0;
  const Vec3 origin = 0.5 * (surface.bounds().low + surface.bounds().high);
  Vec3 sum;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    sum += surface.area(f) / 3.0 * (surface.point(a) + surface.point(b) + surface.point(c) - 3.0 * origin);
    area += surface.area(f);
  }
  frame.centre = area > 0.0 ? origin + sum / area : origin;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [v, w, u] = surface.vertices(f);
    const std::array<Vec3, 3> p{surface.point(v) - frame.centre, surface.point(w) - frame.centre,
                                surface.point(u) - frame.centre};
    // The integral of x x^T over a triangle: area / 12 times the sum over corners and over their sum.
    const Vec3 all = p[0] + p[1] + p[2];
    spread += surface.area(f) / 12.0 *
              (outer_product(p[0], p[0]) + outer_product(p[1], p[1]) + outer_product(p[2], p[2]) +
               outer_product(all, all));
  }
  const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  for (int i = 0; i < 3; ++i) {
    frame.axes[static_cast<std::size_t>(i)] = {v(0, i), v(1, i), v(2, i)};
  }
  return frame;
}

}  // namespace ridgecraft::prepare
