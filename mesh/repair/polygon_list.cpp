// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/polygon_list.hpp"

#include <algorithm>

#include "base/edge_order.hpp"

namespace ridgecraft::mesh {

std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles) {
  std::vector<EdgeUse> uses(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t].points[k];
      const std::uint32_t to = triangles[t].points[(k + 1U) % 3];
      uses[3 * t + k] = {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t), k, from < to};
    }
  }
  return in_edge_order(std::span<const EdgeUse>(uses));
}

}  // namespace ridgecraft::mesh
