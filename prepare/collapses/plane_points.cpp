// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/plane_points.hpp"

#include <cmath>
#include <numeric>

namespace ridgecraft::prepare {

PlanePoints::PlanePoints(const PointRules& points, const std::vector<Vec3>& places, double short_edge)
    : points_(&points),
      plane_(points.plane),
      now_(points.plane.size()),
      crossing_(points.plane.size(), PointRules::none),
      fixed_(points.crossings.size(), false) {
  std::iota(now_.begin(), now_.end(), 0U);
  for (std::uint32_t i = 0; i < points.crossings.size(); ++i) {
    const PointRules::Crossing& c = points.crossings[i];
    const MirrorPlane& plane = points.planes[points.plane[c.point]];
    const double across =
        std::abs(plane.height(places[c.end])) + std::abs(plane.height(places[c.image_of_end]));
    crossing_[c.point] = i;
    fixed_[i] = across > short_edge;
  }
}

void PlanePoints::join(EditMesh::VertexHandle gone, EditMesh::VertexHandle stays) {
  now_[static_cast<std::size_t>(gone.idx())] = static_cast<std::uint32_t>(stays.idx());
  crossing_[static_cast<std::size_t>(gone.idx())] = crossing_[static_cast<std::size_t>(stays.idx())] =
      PointRules::none;
  if (is(gone)) {
    plane_[static_cast<std::size_t>(stays.idx())] = number(gone);
  }
}

bool PlanePoints::is_seam(const EditMesh& mesh, EditMesh::HalfedgeHandle h) const {
  return mesh.is_boundary(mesh.edge_handle(h)) && is(mesh.from_vertex_handle(h)) &&
         is(mesh.to_vertex_handle(h));
}

bool PlanePoints::joins_seam(const EditMesh& mesh, EditMesh::VertexHandle v, EditMesh::VertexHandle on,
                             EditMesh::VertexHandle w) const {
  if (is(v) || !is(on) || !is(w)) {
    return false;
  }
  const auto h = mesh.find_halfedge(on, w);
  return h.is_valid() && is_seam(mesh, h);
}

Vec3 PlanePoints::at(const EditMesh& mesh, EditMesh::VertexHandle v, const Change* change) const {
  if (change != nullptr && change->moves(v)) {
    return change->place;
  }
  if (!is_crossing(v)) {
    return to_vector(mesh.point(v));
  }
  const auto [end, image_of_end] = ends(v);
  return crossing(*plane(v, v), at(mesh, end, change), at(mesh, image_of_end, change));
}

bool PlanePoints::coincide(EditMesh::VertexHandle a, EditMesh::VertexHandle b, const Change* change) const {
  const auto same = [&](EditMesh::VertexHandle u, EditMesh::VertexHandle v) {
    return u == v || (change != nullptr && change->moves(u) && change->moves(v));
  };
  return is_crossing(a) && is_crossing(b) && same(ends(a)[0], ends(b)[0]) && same(ends(a)[1], ends(b)[1]);
}

/// Would the new vertex lie on a plane together with a neighbour that it isn't joined to by a border edge?
/// The edge between them would be one with its mirror image.
bool PlanePoints::closes_on_plane(const EditMesh& mesh, EditMesh::VertexHandle v0, EditMesh::VertexHandle v1,
                                  EditMesh::HalfedgeHandle side) const {
  if (is(v0) == is(v1)) {
    return is(v0) && !mesh.is_boundary(mesh.edge_handle(side));
  }
  const auto on = is(v0) ? v0 : v1;
  const auto off = is(v0) ? v1 : v0;
  for (const auto h : mesh.voh_range(off)) {
    const auto w = mesh.to_vertex_handle(h);
    if (w == on || !is(w)) {
      continue;
    }
    const auto joined = mesh.find_halfedge(on, w);
    if (!joined.is_valid() || !mesh.is_boundary(mesh.edge_handle(joined))) {
      return true;
    }
    // A face that would lie in the plane.
    const auto next = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
    if (!mesh.is_boundary(h) && next != on && is(next)) {
      return true;
    }
  }
  return false;
}

}  // namespace ridgecraft::prepare
