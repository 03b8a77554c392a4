// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/faces_alone.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace ridgecraft::mesh {

namespace {

/// Of fewer faces than one in so many a table of all vertices isn't worth its time.
constexpr std::size_t few = 16;

/// Vertices get numbers as they come, which `number` keeps.
template <class Numbers>
Surface numbered(const Surface& surface, const std::vector<FaceId>& faces, Numbers& number) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners;
  corners.reserve(faces.size());
  for (const FaceId f : faces) {
    std::array<VertexId, 3> own = surface.vertices(f);
    for (VertexId& v : own) {
      VertexId& known = number[v];
      if (!known.valid()) {
        known = VertexId(points.size());
        points.push_back(surface.point(v));
      }
      v = known;
    }
    corners.push_back(own);
  }
  return {std::move(points), std::move(corners)};
}

}  // namespace

Surface faces_alone(const Surface& surface, const std::vector<FaceId>& faces) {
  if (faces.size() >= surface.face_count() / few) {
    IdVector<VertexId, VertexId> number(surface.vertex_count());
    return numbered(surface, faces, number);
  }
  std::map<VertexId, VertexId> number;
  return numbered(surface, faces, number);
}

}  // namespace ridgecraft::mesh
