// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies are around the patches of an arrangement. For .cpp files of prepare/skin/ only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "prepare/skin/exact.hpp"
#include "prepare/skin/facets.hpp"

namespace ridgecraft::prepare {

/// Triangles whose corners are the first points at their places.
struct PlacedSoup {
  const BodySoup& soup;
  std::vector<Corners> corners;      ///< of each triangle
  std::vector<std::uint32_t> whole;  ///< triangles with an area

  [[nodiscard]] bool is_solid(std::uint32_t t) const { return soup.solid[soup.body[t]] != 0; }
};

/// Sets front and back of all patches by rays from their facets. `largest`: the largest facet of each patch.
/// O(log n) a patch where triangles are spread.
void find_windings(const PlacedSoup& soup, ExactPoints& points, const std::vector<std::uint32_t>& largest,
                   Arrangement& arranged, const Context& context);

}  // namespace ridgecraft::prepare
