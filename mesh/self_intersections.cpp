// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/self_intersections.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace ridgecraft::mesh {

std::size_t count_self_intersections(const Surface& surface) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  if (surface.face_count() > most_faces_for_self_intersections) {
    return 0;
  }
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (const Vec3 p : surface.points()) {
    vertices.push_back(mesh.add_vertex(Kernel::Point_3(p.x, p.y, p.z)));
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    // Faces without area have no plane that CGAL could cut with.
    if (surface.normal(f) != Vec3{}) {
      const auto [a, b, c] = surface.vertices(f);
      mesh.add_face(vertices[a.value()], vertices[b.value()], vertices[c.value()]);
    }
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  const auto touch = [&](const auto& pair) {
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(pair.first))) {
      for (const Mesh::Vertex_index w : mesh.vertices_around_face(mesh.halfedge(pair.second))) {
        if (mesh.point(v) == mesh.point(w)) {
          return true;
        }
      }
    }
    return false;
  };
  return pairs.size() - static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), touch));
}

}  // namespace ridgecraft::mesh
