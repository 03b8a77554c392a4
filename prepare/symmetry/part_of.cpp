// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>

#include "base/disjoint_sets.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

/// Corners of the part (3 * place of the face in the list + k) that are one vertex: those that neighbours
/// within the part share.
DisjointSets fans(const mesh::Surface& whole, std::span<const FaceId> faces) {
  std::vector<std::pair<FaceId, std::uint32_t>> place;
  place.reserve(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    place.emplace_back(faces[i], i);
  }
  std::sort(place.begin(), place.end());
  DisjointSets sets(3 * faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId twin = whole.twin(mesh::corner(faces[i], k));
      if (!twin.valid()) {
        continue;
      }
      const auto found =
          std::lower_bound(place.begin(), place.end(), std::pair(mesh::face_of(twin), std::uint32_t{0}));
      if (found == place.end() || found->first != mesh::face_of(twin)) {
        continue;
      }
      const std::uint32_t other = 3 * found->second;
      sets.join(3 * i + k, other + mesh::next(twin).value() % 3);
      sets.join(3 * i + (k + 1) % 3, other + twin.value() % 3);
    }
  }
  return sets;
}

}  // namespace

PartOf part_of(const mesh::Surface& whole, std::span<const FaceId> faces) {
  PartOf part;
  part.face = IdVector<FaceId, FaceId>(std::vector<FaceId>(faces.begin(), faces.end()));
  DisjointSets sets = fans(whole, faces);
  std::vector<std::uint32_t> number(3 * faces.size(), VertexId::none_value);
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      std::uint32_t& own = number[sets.find(3 * i + k)];
      if (own == VertexId::none_value) {
        const VertexId v = whole.vertex(mesh::corner(faces[i], k));
        own = part.vertex.push_back(v).value();
        points.push_back(whole.point(v));
      }
      corners[i][k] = VertexId(own);
    }
  }
  part.surface = mesh::Surface(std::move(points), std::move(corners));
  part.edge.resize(part.surface.edge_count());
  for (const FaceId f : ids<FaceId>(faces.size())) {
    for (unsigned k = 0; k < 3; ++k) {
      part.edge[part.surface.edge(mesh::corner(f, k))] = whole.edge(mesh::corner(faces[f.value()], k));
    }
  }
  return part;
}

}  // namespace ridgecraft::prepare
