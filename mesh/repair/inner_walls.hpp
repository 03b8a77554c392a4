// SPDX-License-Identifier: GPL-3.0-or-later
// Walls between solids that are there from either side. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Two polygons of a list with the same corners in opposite order.
using WallPair = std::array<std::uint32_t, 2>;

/// Those of the pairs that two solids have between them: without both copies the rest closes at the rim of
/// the wall, as many sides running one way as the other. What ends at nothing is a sheet that was drawn from
/// both sides, and so is what closes by itself. `pairs`: each polygon in one pair at most. O(n log n).
[[nodiscard]] std::vector<WallPair> walls_between_solids(const PolygonList& list,
                                                         const std::vector<WallPair>& pairs);

}  // namespace ridgecraft::mesh
