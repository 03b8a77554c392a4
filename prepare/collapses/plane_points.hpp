// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a share that its mirror plane holds, while collapses go on. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "prepare/collapses/edit_mesh.hpp"
#include "prepare/shares/collapse.hpp"

namespace ridgecraft::prepare {

/// Two vertices of an edge become one, at a place.
struct Change {
  EditMesh::VertexHandle v0;
  EditMesh::VertexHandle v1;
  Vec3 place;
  [[nodiscard]] bool moves(EditMesh::VertexHandle v) const { return v == v0 || v == v1; }
};

/// Which vertices stay on planes, and where those are that go along with others. The rules must outlive it.
class PlanePoints {
 public:
  /// Crossings of edges longer than `short_edge` across the plane stay where they are.
  PlanePoints(const PointRules& points, const std::vector<Vec3>& places, double short_edge);

  [[nodiscard]] bool is(EditMesh::VertexHandle v) const { return number(v) != PointRules::none; }
  /// The plane of either vertex; no edge joins vertices of two planes.
  [[nodiscard]] const MirrorPlane* plane(EditMesh::VertexHandle v0, EditMesh::VertexHandle v1) const {
    const std::uint32_t found = is(v0) ? number(v0) : number(v1);
    return found == PointRules::none ? nullptr : &points_->planes[found];
  }
  void join(EditMesh::VertexHandle gone, EditMesh::VertexHandle stays);
  [[nodiscard]] std::uint32_t copies(EditMesh::VertexHandle v) const {
    return points_->copies[static_cast<std::size_t>(v.idx())];
  }

  /// Does the mirror image lie across this side?
  [[nodiscard]] bool is_seam(const EditMesh& mesh, EditMesh::HalfedgeHandle h) const;
  /// Will the side from v to w lie on the plane when v becomes one with `on`?
  [[nodiscard]] bool joins_seam(const EditMesh& mesh, EditMesh::VertexHandle v, EditMesh::VertexHandle on,
                                EditMesh::VertexHandle w) const;

  /// Whether the collapse of an edge, of which `side` is one half-edge, would spoil the symmetric whole.
  [[nodiscard]] bool forbids(const EditMesh& mesh, EditMesh::VertexHandle v0, EditMesh::VertexHandle v1,
                             EditMesh::HalfedgeHandle side) const {
    return is_fixed(v0) || is_fixed(v1) || closes_on_plane(mesh, v0, v1, side);
  }

  /// Where a vertex is (after a change, if given): crossings go along with the ends of their edges until they
  /// are changed themselves, or an end comes to the plane.
  [[nodiscard]] Vec3 at(const EditMesh& mesh, EditMesh::VertexHandle v, const Change* change) const;
  [[nodiscard]] bool follows(EditMesh::VertexHandle v, const Change& change) const {
    return is_crossing(v) && (change.moves(ends(v)[0]) || change.moves(ends(v)[1]));
  }
  /// Are these crossings of one edge after a change?
  [[nodiscard]] bool coincide(EditMesh::VertexHandle a, EditMesh::VertexHandle b, const Change* change) const;

 private:
  [[nodiscard]] bool closes_on_plane(const EditMesh& mesh, EditMesh::VertexHandle v0,
                                     EditMesh::VertexHandle v1, EditMesh::HalfedgeHandle side) const;
  [[nodiscard]] bool is_crossing(EditMesh::VertexHandle v) const {
    return crossing_[static_cast<std::size_t>(v.idx())] != PointRules::none && !is(ends(v)[0]) &&
           !is(ends(v)[1]);
  }
  [[nodiscard]] bool is_fixed(EditMesh::VertexHandle v) const {
    const std::uint32_t crossing = crossing_[static_cast<std::size_t>(v.idx())];
    return crossing != PointRules::none && fixed_[crossing];
  }
  [[nodiscard]] EditMesh::VertexHandle now(std::uint32_t v) const {
    while (now_[v] != v) {
      v = now_[v];
    }
    return EditMesh::VertexHandle(static_cast<int>(v));
  }
  [[nodiscard]] std::array<EditMesh::VertexHandle, 2> ends(EditMesh::VertexHandle v) const {
    const PointRules::Crossing& c = points_->crossings[crossing_[static_cast<std::size_t>(v.idx())]];
    return {now(c.end), now(c.image_of_end)};
  }
  [[nodiscard]] std::uint32_t number(EditMesh::VertexHandle v) const {
    return plane_[static_cast<std::size_t>(v.idx())];
  }

  const PointRules* points_;
  std::vector<std::uint32_t> plane_;
  std::vector<std::uint32_t> now_;       ///< what each vertex became part of
  std::vector<std::uint32_t> crossing_;  ///< of each vertex: its number among crossings
  std::vector<bool> fixed_;              ///< of each crossing: no collapse may touch it
};

}  // namespace ridgecraft::prepare
