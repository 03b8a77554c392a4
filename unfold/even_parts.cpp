// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/even_parts.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "unfold/patch/patch.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/pieces/mirror_units.hpp"

namespace ridgecraft::unfold {

IdVector<FaceId, PartId> even_parts(const mesh::Surface& surface, const prepare::Panels& panels,
                                    IdVector<FaceId, PartId> part, const Weights& weights) {
  const MirrorImages images = mirror_images(surface, weights);
  if (images.edge.empty()) {
    return part;
  }
  std::vector<FaceId> faces;
  std::vector<std::uint32_t> part_of_face;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
    part_of_face.push_back(part[f].value());
  }
  const Patch patch = make_patch(surface, panels, faces);
  std::vector<std::uint8_t> within(patch.twin.size(), 0);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    within[side] = twin != nothing && part_of_face[side / 3] == part_of_face[twin / 3] ? 1 : 0;
  }
  const MirrorUnits units(surface, patch, images);
  const std::vector<std::uint8_t> crosses = units.crossing(patch, within, part_of_face);
  auto even = connected_labels(patch, units.carried_over(part_of_face, crosses, true));
  auto other = connected_labels(patch, units.carried_over(part_of_face, crosses, false));
  if (other.size() < even.size()) {
    even = std::move(other);
  }
  for (std::uint32_t i = 0; i < even.size(); ++i) {
    for (const std::uint32_t f : even[i].second) {
      part[FaceId(f)] = PartId(i);
    }
  }
  return part;
}

}  // namespace ridgecraft::unfold
