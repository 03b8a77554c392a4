// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/material_table.hpp"

#include <fmt/format.h>

namespace ridgecraft::mesh {

void MaterialTable::finish(Material& material, std::optional<ColourBytes> own, std::uint32_t number) {
  if (own) {
    material.colour = colour_of(*own);
  }
  if (material.name.empty()) {
    material.name = fmt::format("paint {}", number + 1);
  }
}

}  // namespace ridgecraft::mesh
