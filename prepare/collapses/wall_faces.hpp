// SPDX-License-Identifier: GPL-3.0-or-later
// Walls while collapses go on: which faces are left of them, and where a vertex of some may be. Private to
// prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prepare/collapses/edit_mesh.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// The walls must outlive it.
class WallFaces {
 public:
  /// Vertices may be off the plane of a wall by up to `tolerance`; steps shorter than `step` may vanish, and
  /// move it by up to a sixth of that.
  WallFaces(const Walls& walls, double tolerance, double step);

  [[nodiscard]] bool is_wall(EditMesh::FaceHandle face) const { return wall(face) != Walls::none; }
  /// The walls around either vertex, ascending, each once.
  [[nodiscard]] std::vector<std::uint32_t> around(const EditMesh& mesh, EditMesh::VertexHandle v0,
                                                  EditMesh::VertexHandle v1) const;
  /// Whether a place is in all of these. Edges of a slit or a step that is as good as none (`edge` is their
  /// length) may leave the plane by less than the thickness of paper.
  [[nodiscard]] bool holds(const std::vector<std::uint32_t>& walls, Vec3 place, double edge) const;
  /// Whether the collapse of an edge would leave nothing of a wall.
  [[nodiscard]] bool ends_one(const EditMesh& mesh, EditMesh::HalfedgeHandle side) const;
  /// A collapse removes a face.
  void remove(EditMesh::FaceHandle face);

  /// The place in all of these planes (and in the mirror plane, if given) where a quadric error is least;
  /// where it doesn't tell, as near as can be to `start`. None where the planes have no common point.
  [[nodiscard]] std::optional<Vec3> best_place(const std::vector<std::uint32_t>& walls,
                                               const MirrorPlane* mirror, const Eigen::Matrix4d& quadric,
                                               Vec3 start, double edge) const;

 private:
  [[nodiscard]] std::uint32_t wall(EditMesh::FaceHandle face) const {
    return walls_->wall(static_cast<std::size_t>(face.idx()));
  }

  const Walls* walls_;
  double tolerance_;
  double step_;
  bool any_ = false;                 ///< whether any face is of a wall
  std::vector<std::uint32_t> left_;  ///< faces of each wall
};

}  // namespace ridgecraft::prepare
