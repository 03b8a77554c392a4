// SPDX-License-Identifier: GPL-3.0-or-later
// Corners that lie on a neighbour's side. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Where border points lie within `distance` of a border edge, and another triangle's border edge runs along
/// a part of it, the edge's triangle is divided at them, so that the seam closes. Returns how many points
/// were set into edges. A border point must also be nearer than near_of_edge (weld.hpp) of its own border
/// edges. `uses`: those of the list's edges, before and after. O(n log n) where few points lie on one edge.
std::size_t join_t_junctions(TriangleList& list, std::vector<EdgeUse>& uses, double distance,
                             const Context& context);

}  // namespace ridgecraft::mesh
