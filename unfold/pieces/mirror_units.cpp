// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/mirror_units.hpp"

#include <algorithm>

#include "base/disjoint_sets.hpp"
#include "unfold/pieces/unit_images.hpp"

namespace ridgecraft::unfold {

MirrorUnits::MirrorUnits(const mesh::Surface& surface, const Patch& patch, const MirrorImages& images)
    : unit_(units_of(patch)), image_(patch.size(), nothing), height_(patch.size(), 0.0) {
  find_heights(surface, patch, images.plane);
  find_images(surface, patch, images);
}

void MirrorUnits::find_heights(const mesh::Surface& surface, const Patch& patch,
                               const prepare::MirrorPlane& plane) {
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    double height = 0.0;
    for (const VertexId v : surface.vertices(patch.face[f])) {
      height += plane.height(surface.point(v)) / 3.0;
    }
    height_[unit_[f]] += height * area_of(patch.shape[f]);
  }
}

void MirrorUnits::find_images(const mesh::Surface& surface, const Patch& patch, const MirrorImages& images) {
  const std::vector<std::uint32_t> best = unit_images(surface, patch, unit_, images.edge);
  for (std::uint32_t u = 0; u < patch.size(); ++u) {
    if (best[u] != nothing && best[best[u]] == u && (best[u] == u || is_above(u) != is_above(best[u]))) {
      image_[u] = best[u];
    }
  }
}

std::vector<std::uint8_t> MirrorUnits::crossing(const Patch& patch, std::span<const std::uint8_t> joined,
                                                std::span<const std::uint32_t> set_of_face) const {
  std::uint32_t sets = 0;
  for (const std::uint32_t set : set_of_face) {
    sets = std::max(sets, set + 1);
  }
  std::vector<std::uint8_t> crosses(sets, 0);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t u = unit_[side / 3];
    const bool across = joined[side] != 0 && is_above(u) != is_above(unit_[patch.twin[side] / 3]);
    if (across || image_[u] == u) {
      crosses[set_of_face[side / 3]] = 1;
    }
  }
  return crosses;
}

std::vector<MirrorLabel> MirrorUnits::carried_over(std::span<const std::uint32_t> set_of_face,
                                                   std::span<const std::uint8_t> crosses, bool above) const {
  std::vector<std::uint32_t> set_of_unit(unit_.size(), nothing);
  for (std::uint32_t f = 0; f < unit_.size(); ++f) {
    set_of_unit[unit_[f]] = set_of_face[f];
  }
  std::vector<MirrorLabel> labels;
  for (std::uint32_t f = 0; f < unit_.size(); ++f) {
    const std::uint32_t u = unit_[f];
    const std::uint32_t image = image_[u];
    if (image == nothing || image == u || is_above(u) == above) {
      labels.push_back({set_of_face[f], false});
    } else {
      const std::uint32_t set = set_of_unit[image];
      labels.push_back({set, crosses[set] == 0});
    }
  }
  return labels;
}

std::vector<std::pair<MirrorLabel, std::vector<std::uint32_t>>> connected_labels(
    const Patch& patch, std::span<const MirrorLabel> labels) {
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && labels[side / 3] == labels[twin / 3]) {
      static_cast<void>(sets.join(side / 3, twin / 3));
    }
  }
  std::vector<std::uint32_t> place(patch.size(), nothing);
  std::vector<std::pair<MirrorLabel, std::vector<std::uint32_t>>> result;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    std::uint32_t& at = place[sets.find(f)];
    if (at == nothing) {
      at = static_cast<std::uint32_t>(result.size());
      result.push_back({labels[f], {}});
    }
    result[at].second.push_back(f);
  }
  return result;
}

}  // namespace ridgecraft::unfold
