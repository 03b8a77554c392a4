// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface.hpp"

#include <algorithm>

#include "base/elementary.hpp"
#include "base/error.hpp"

namespace ridgecraft::mesh {

// By value: who gives the faces away needn't hold them beside the corners that they become.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
Surface::Surface(std::vector<Vec3> points, std::vector<std::array<VertexId, 3>> faces)
    : points_(std::move(points)) {
  corners_.reserve(3 * faces.size());
  for (const auto& face : faces) {
    corners_.insert(corners_.end(), face.begin(), face.end());
  }
  connect();
  measure();
  find_components();
}

void Surface::connect() {
  const std::size_t n = corners_.size();
  // Counting sort of the corners by vertex; the faces of each vertex come in ascending order.
  vertex_first_.assign(points_.size() + 1, 0);
  for (const VertexId v : corners_) {
    RIDGECRAFT_ASSERT(v.value() < points_.size());
    ++vertex_first_[v.value() + 1];
  }
  for (std::size_t v = 0; v < points_.size(); ++v) {
    vertex_first_[v + 1] += vertex_first_[v];
  }
  vertex_corners_.resize(n);
  std::vector<std::uint32_t> fill(vertex_first_.begin(), vertex_first_.end() - (points_.empty() ? 0 : 1));
  for (std::size_t c = 0; c < n; ++c) {
    vertex_corners_[fill[corners_[c].value()]++] = CornerId(c);
  }

  twins_.assign(n, CornerId());
  corner_edges_.assign(n, EdgeId());
  edges_.reserve(n / 2 + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const CornerId c(i);
    if (corner_edges_[i].valid()) {
      continue;
    }
    const VertexId from = vertex(c);
    const VertexId to = vertex(next(c));
    RIDGECRAFT_ASSERT(from != to);
    // Look from the end with fewer faces, so that the hub of a large fan costs no more than its rim.
    CornerId twin;
    if (corners_at(to).size() <= corners_at(from).size()) {
      for (const CornerId d : corners_at(to)) {
        if (vertex(next(d)) == from) {
          RIDGECRAFT_ASSERT(!twin.valid());
          twin = d;
        }
      }
    } else {
      for (const CornerId d : corners_at(from)) {
        if (vertex(previous(d)) == to) {
          RIDGECRAFT_ASSERT(!twin.valid());
          twin = previous(d);
        }
      }
    }
    const EdgeId e(edges_.size());
    edges_.push_back({c, twin});
    corner_edges_[i] = e;
    twins_[i] = twin;
    if (twin.valid()) {
      RIDGECRAFT_ASSERT(!corner_edges_[twin.value()].valid());
      corner_edges_[twin.value()] = e;
      twins_[twin.value()] = c;
    }
  }
}

void Surface::measure() {
  for (const Vec3 p : points_) {
    bounds_.add(p);
  }
  areas_.resize(face_count());
  normals_.resize(face_count());
  for (const FaceId f : ids<FaceId>(face_count())) {
    const auto [a, b, c] = vertices(f);
    const Vec3 doubled = ridgecraft::cross(point(b) - point(a), point(c) - point(a));
    areas_[f.value()] = 0.5 * ridgecraft::length(doubled);
    normals_[f.value()] = normalized(doubled);
  }
  lengths_.resize(edge_count());
  fold_angles_.resize(edge_count());
  for (const EdgeId e : ids<EdgeId>(edge_count())) {
    const auto [c, d] = sides(e);
    const Vec3 along = point(vertex(next(c))) - point(vertex(c));
    lengths_[e.value()] = ridgecraft::length(along);
    if (d.valid()) {
      const Vec3 n = normal(face_of(c));
      const Vec3 m = normal(face_of(d));
      // n x m points along the side of c where the edge is convex, against it where it is concave.
      const double sine = dot(ridgecraft::cross(n, m), normalized(along));
      const double cosine = dot(n, m);
      fold_angles_[e.value()] = sine == 0.0 && cosine == 0.0 ? 0.0 : -elementary::atan2(sine, cosine);
    }
  }
}

void Surface::find_components() {
  components_.assign(face_count(), ComponentId());
  std::vector<FaceId> stack;
  for (const FaceId start : ids<FaceId>(face_count())) {
    if (components_[start.value()].valid()) {
      continue;
    }
    const ComponentId id(component_count_++);
    components_[start.value()] = id;
    stack.push_back(start);
    while (!stack.empty()) {
      const FaceId f = stack.back();
      stack.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = neighbor(corner(f, k));
        if (g.valid() && !components_[g.value()].valid()) {
          components_[g.value()] = id;
          stack.push_back(g);
        }
      }
    }
  }
}

Box3 Surface::bounds(FaceId f) const {
  Box3 box;
  for (const VertexId v : vertices(f)) {
    box.add(point(v));
  }
  return box;
}

double total_area(const Surface& surface) {
  double area = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area += surface.area(f);
  }
  return area;
}

}  // namespace ridgecraft::mesh
