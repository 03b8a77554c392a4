// SPDX-License-Identifier: GPL-3.0-or-later
// What one collapse would do to the faces around it. Private to prepare/.
#pragma once

#include <vector>

#include "prepare/collapses/edit_mesh.hpp"
#include "prepare/collapses/plane_points.hpp"
#include "prepare/collapses/wall_faces.hpp"

namespace ridgecraft::prepare {

/// A face around the collapsed edge: its corner at the edge moves to the new place, the other two stay.
struct Rim {
  EditMesh::VertexHandle from;
  EditMesh::VertexHandle to;
  Vec3 old_normal;
  Vec3 new_normal;
  Vec3 outer_normal;  ///< of the face across the side that stays; zero where there is none
  bool was_at_plane;  ///< its mirror image lay across one of its sides ...
  bool at_plane;      ///< ... and will
};

/// Fills `rim` with the faces that stay and tells whether none of them is spoiled: turned over, folded shut,
/// or made thinner than the old ones and than is good. How a wall is divided into faces doesn't matter.
[[nodiscard]] bool harmless(const EditMesh& mesh, const PlanePoints& bound, const WallFaces& walls,
                            const Change& change, std::vector<Rim>& rim);

/// `drift` is per vertex a bound of how far the original surface around it is from the present one. That of
/// the new vertex: the old ones' and how far they are from the new faces.
[[nodiscard]] double drift_after(const EditMesh& mesh, const Change& change, const std::vector<Rim>& rim,
                                 const std::vector<double>& drift);

}  // namespace ridgecraft::prepare
