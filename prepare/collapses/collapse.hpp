// SPDX-License-Identifier: GPL-3.0-or-later
// The half-edge mesh that CGAL's algorithms change. Private to prepare/, where only headers of what
// works on this mesh include it; no file may include CGAL's OpenMesh traits but through it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

struct EditTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status);
};

using EditMesh = OpenMesh::TriMesh_ArrayKernelT<EditTraits>;
using EditKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

[[nodiscard]] inline Vec3 to_vector(const EditMesh::Point& p) {
  return {p[0], p[1], p[2]};
}

}  // namespace ridgecraft::prepare

namespace CGAL {

/// CGAL 5.5 writes points of every OpenMesh mesh through float. This stands in for its map, before anything
/// uses it, and keeps doubles; tests/prepare/simplify_test.cpp holds it to that.
template <>
class OM_point_pmap<ridgecraft::prepare::EditMesh, ridgecraft::prepare::EditKernel::Point_3> {
  using Mesh = ridgecraft::prepare::EditMesh;
  using Place = ridgecraft::prepare::EditKernel::Point_3;

 public:
  using category = boost::read_write_property_map_tag;
  using value_type = Place;
  using reference = Place;
  using key_type = boost::graph_traits<Mesh>::vertex_descriptor;

  OM_point_pmap() = default;
  explicit OM_point_pmap(const Mesh& mesh) : mesh_(&mesh) {}
  reference operator[](key_type v) const {
    const auto& p = mesh_->point(v);
    return {p[0], p[1], p[2]};
  }
  friend reference get(const OM_point_pmap& map, key_type v) { return map[v]; }
  friend void put(const OM_point_pmap& map, key_type v, const value_type& p) {
    // CGAL's interface hands the mesh over as const and yet writes to it.
    const_cast<Mesh*>(map.mesh_)->set_point(v, Mesh::Point(p.x(), p.y(), p.z()));
  }

 private:
  const Mesh* mesh_ = nullptr;
};

}  // namespace CGAL

namespace ridgecraft::prepare {

/// Vertices and faces get the numbers that they have in `loose`, which must fulfil mesh::Surface's
/// invariants.
[[nodiscard]] inline EditMesh edit_mesh(const mesh::LooseFaces& loose) {
  EditMesh mesh;
  mesh.reserve(loose.points.size(), loose.points.size() + loose.faces.size(), loose.faces.size());
  for (const Vec3 p : loose.points) {
    mesh.add_vertex(EditMesh::Point(p.x, p.y, p.z));
  }
  const auto handle = [](std::uint32_t v) { return EditMesh::VertexHandle(static_cast<int>(v)); };
  for (const auto& [a, b, c] : loose.faces) {
    mesh.add_face(handle(a), handle(b), handle(c));
  }
  return mesh;
}

/// Walls while collapses go on: which faces are left of them, and where a vertex of some may be. The walls
/// must outlive it.
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

  [[nodiscard]] bool is(EditMesh::VertexHandle v) const { return number(v) != no_index; }
  /// The plane of either vertex; no edge joins vertices of two planes.
  [[nodiscard]] const MirrorPlane* plane(EditMesh::VertexHandle v0, EditMesh::VertexHandle v1) const {
    const std::uint32_t found = is(v0) ? number(v0) : number(v1);
    return found == no_index ? nullptr : &points_->planes[found];
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
    return crossing_[static_cast<std::size_t>(v.idx())] != no_index && !is(ends(v)[0]) && !is(ends(v)[1]);
  }
  [[nodiscard]] bool is_fixed(EditMesh::VertexHandle v) const {
    const std::uint32_t crossing = crossing_[static_cast<std::size_t>(v.idx())];
    return crossing != no_index && fixed_[crossing];
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
