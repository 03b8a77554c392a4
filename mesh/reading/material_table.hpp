// SPDX-License-Identifier: GPL-3.0-or-later
// Materials of formats whose faces may have a colour of their own besides: one for each pair that is
// different.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// A colour in 256 steps a channel, as files and screens have it.
using ColourBytes = std::array<std::uint8_t, 3>;

[[nodiscard]] constexpr Colour colour_of(ColourBytes bytes) {
  return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0};
}

class MaterialTable {
 public:
  /// Paints the soup's last polygon. `id` is the number that the file gives to the material, Soup::none for
  /// none; `material` is called for its value the first time. A colour of the face's own takes the place of
  /// the material's.
  template <class MaterialOf>
  void paint(Soup& soup, std::uint32_t id, std::optional<ColourBytes> own, const MaterialOf& material) {
    if (id == Soup::none && !own) {
      return;
    }
    const auto [found, fresh] = number_.try_emplace({id, own}, static_cast<std::uint32_t>(number_.size()));
    if (fresh) {
      soup.materials.push_back(id == Soup::none ? Material{} : material(id));
      finish(soup.materials.back(), own, found->second);
    }
    soup.polygon_material.resize(soup.polygon_count() - 1, Soup::none);
    soup.polygon_material.push_back(found->second);
  }

  /// Polygons after the last painted one have none.
  void finish(Soup& soup) const {
    if (!number_.empty()) {
      soup.polygon_material.resize(soup.polygon_count(), Soup::none);
    }
  }

 private:
  static void finish(Material& material, std::optional<ColourBytes> own, std::uint32_t number);

  std::map<std::pair<std::uint32_t, std::optional<ColourBytes>>, std::uint32_t> number_;
};

}  // namespace ridgecraft::mesh
