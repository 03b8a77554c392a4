// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/face_paint.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ridgecraft::mesh {

void FacePaint::add(Soup& soup, std::optional<Colour> colour, std::uint32_t picture) {
  if (!colour && picture == Soup::none) {
    return;
  }
  if (colour) {
    for (double& channel : *colour) {
      channel = std::isnan(channel) ? 1.0 : std::clamp(channel, 0.0, 1.0);
    }
  }
  const auto [found, fresh] =
      number_.try_emplace({colour, picture}, static_cast<std::uint32_t>(number_.size()));
  soup.polygon_material.resize(soup.polygon_count() - 1, Soup::none);
  soup.polygon_material.push_back(found->second);
}

void FacePaint::finish(Soup& soup, const std::vector<PictureFinder::Found>& pictures) const {
  if (number_.empty()) {
    return;
  }
  soup.polygon_material.resize(soup.polygon_count(), Soup::none);
  soup.materials.resize(number_.size());
  for (const auto& [key, number] : number_) {
    Material& material = soup.materials[number];
    material.name = fmt::format("paint {}", number + 1);
    material.colour = key.first;
    if (key.second < pictures.size()) {
      material.texture_file = pictures[key.second].file;
      material.picture = pictures[key.second].bytes;
    }
  }
}

}  // namespace ridgecraft::mesh
