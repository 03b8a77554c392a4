// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "prepare/prepared/options.hpp"
#include "prepare/selection/selection.hpp"

namespace ridgecraft::prepare {
namespace {

/// What is scattered has this share of the bodies at least, ...
constexpr double least_of_bodies = 0.5;
/// ... and this one of the model's area at most: else it is what the model is made of.
constexpr double most_of_area = 0.4;

/// Of its object; of its material where objects have no names.
std::string name_of(const mesh::Model& model, FaceId face) {
  std::string object = model.object_name(face);
  const std::uint32_t material = model.material.empty() ? mesh::Soup::none : model.material[face];
  return object.empty() && material != mesh::Soup::none ? model.materials[material].name : object;
}

}  // namespace

std::optional<Scattered> scattered_name(const mesh::Model& model) {
  const mesh::Surface& surface = model.surface;
  if (surface.component_count() <= most_loose_bodies) {
    return std::nullopt;
  }
  struct Share {
    std::size_t bodies = 0;
    double area = 0.0;
  };
  std::map<std::string, Share> shares;
  std::vector<bool> seen(surface.component_count(), false);
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    Share& share = shares[name_of(model, face)];
    share.area += surface.area(face);
    if (!seen[surface.component(face).value()]) {
      seen[surface.component(face).value()] = true;
      ++share.bodies;
    }
  }
  const auto most = std::max_element(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
    return a.second.bodies < b.second.bodies;
  });
  const auto& [name, share] = *most;
  const bool is_most =
      static_cast<double>(share.bodies) >= least_of_bodies * static_cast<double>(surface.component_count());
  if (name.empty() || !is_most || share.area > most_of_area * mesh::total_area(surface)) {
    return std::nullopt;
  }
  return Scattered{name, share.bodies};
}

}  // namespace ridgecraft::prepare
