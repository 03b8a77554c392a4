// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/faces_alone.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace ridgecraft::mesh {

Surface faces_alone(const Surface& surface, const std::vector<FaceId>& faces) {
  std::map<VertexId, VertexId> number;
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners;
  for (const FaceId f : faces) {
    std::array<VertexId, 3> own = surface.vertices(f);
    for (VertexId& v : own) {
      const auto [at, fresh] = number.try_emplace(v, static_cast<std::uint32_t>(points.size()));
      if (fresh) {
        points.push_back(surface.point(v));
      }
      v = at->second;
    }
    corners.push_back(own);
  }
  return {std::move(points), std::move(corners)};
}

}  // namespace ridgecraft::mesh
