// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/wall_faces.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace ridgecraft::prepare {
namespace {

/// Directions in which the error grows by less than this share of its largest growth don't matter to it.
constexpr double tells = 1e-3;

Vec3 to_vec3(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Eigen::Vector3d to_eigen(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// The place within planes where an error is least.
Vec3 least_error(const Meeting& meeting, const Eigen::Matrix4d& quadric) {
  if (meeting.directions().size() == 3) {
    return meeting.place();
  }
  Eigen::Matrix3d within = Eigen::Matrix3d::Identity();
  for (const Vec3 d : meeting.directions()) {
    within -= to_eigen(d) * to_eigen(d).transpose();
  }
  Eigen::Vector3d place = to_eigen(meeting.place());
  const Eigen::Matrix3d growth = within * quadric.topLeftCorner<3, 3>() * within;
  const Eigen::Vector3d slope =
      within * (quadric.topLeftCorner<3, 3>() * place + quadric.topRightCorner<3, 1>());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(growth);
  const double largest = solver.eigenvalues()(2);
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()(i);
    if (value > tells * largest && value > 0.0) {
      const Eigen::Vector3d axis = solver.eigenvectors().col(i);
      place -= (axis.dot(slope) / value) * axis;
    }
  }
  return to_vec3(place);
}

}  // namespace

WallFaces::WallFaces(const Walls& walls, double tolerance, double step)
    : walls_(&walls), tolerance_(tolerance), step_(step), left_(walls.walls.size(), 0) {
  for (const std::uint32_t wall : walls.of_face) {
    if (wall != Walls::none) {
      ++left_[wall];
      any_ = true;
    }
  }
}

std::vector<std::uint32_t> WallFaces::around(const EditMesh& mesh, EditMesh::VertexHandle v0,
                                             EditMesh::VertexHandle v1) const {
  std::vector<std::uint32_t> found;
  if (!any_) {
    return found;
  }
  for (const auto v : {v0, v1}) {
    for (const auto f : mesh.vf_range(v)) {
      if (is_wall(f)) {
        found.push_back(wall(f));
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool WallFaces::holds(const std::vector<std::uint32_t>& walls, Vec3 place, double edge) const {
  const double tolerance = edge < step_ ? std::max(tolerance_, step_ / 6.0) : tolerance_;
  return std::all_of(walls.begin(), walls.end(),
                     [&](std::uint32_t w) { return std::abs(walls_->walls[w].height(place)) <= tolerance; });
}

bool WallFaces::ends_one(const EditMesh& mesh, EditMesh::HalfedgeHandle side) const {
  const auto opposite = mesh.opposite_halfedge_handle(side);
  const auto wall_beside = [&](EditMesh::HalfedgeHandle h) {
    return mesh.is_boundary(h) ? Walls::none : wall(mesh.face_handle(h));
  };
  const std::uint32_t a = wall_beside(side);
  const std::uint32_t b = wall_beside(opposite);
  return (a != Walls::none && left_[a] <= (a == b ? 2U : 1U)) || (b != Walls::none && left_[b] <= 1U);
}

void WallFaces::remove(EditMesh::FaceHandle face) {
  if (is_wall(face)) {
    --left_[wall(face)];
  }
}

std::optional<Vec3> WallFaces::best_place(const std::vector<std::uint32_t>& walls, const MirrorPlane* mirror,
                                          const Eigen::Matrix4d& quadric, Vec3 start, double edge) const {
  Meeting meeting(start);
  if (mirror != nullptr) {
    meeting.add(mirror->normal, mirror->offset);
  }
  for (const std::uint32_t w : walls) {
    meeting.add(walls_->walls[w].normal, walls_->walls[w].offset);
  }
  const Vec3 place = least_error(meeting, quadric);
  return holds(walls, place, edge) ? std::optional(place) : std::nullopt;
}

}  // namespace ridgecraft::prepare
