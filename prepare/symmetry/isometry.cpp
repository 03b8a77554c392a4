// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/isometry.hpp"

#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>

#include "prepare/symmetry/eigen.hpp"

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

namespace {

/// 0.1 degrees, as in prepare/prepared/panels.hpp.
constexpr double unseen_fold = 0.0017453;

}  // namespace

IdVector<EdgeId, double> seen_lengths(const mesh::Surface& surface) {
  IdVector<EdgeId, double> seen(surface.edge_count(), 0.0);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    seen[e] = std::abs(surface.fold_angle(e)) > unseen_fold ? surface.length(e) : 0.0;
  }
  return seen;
}

double length_with_image(const IdVector<EdgeId, double>& seen, const IdVector<EdgeId, EdgeId>& images) {
  double length = 0.0;
  for (const EdgeId e : ids<EdgeId>(seen.size())) {
    length += images[e].valid() ? seen[e] : 0.0;
  }
  return length;
}

}  // namespace ridgecraft::prepare
