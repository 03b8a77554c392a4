// SPDX-License-Identifier: GPL-3.0-or-later
// The half-edge mesh that CGAL's algorithms change. Private to prepare/, where only headers of what
// works on this mesh include it; no file may include CGAL's OpenMesh traits but through it.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "base/vector.hpp"
#include "mesh/repair/loose_faces.hpp"

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

}  // namespace ridgecraft::prepare
