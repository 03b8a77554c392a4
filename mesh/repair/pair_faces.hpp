// SPDX-License-Identifier: GPL-3.0-or-later
// Which two of the many faces at an edge belong together, and which side of a component is its outside.
// Private to mesh/.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Divides edges with more than two triangles among pairs of these, by giving points to the fans around them
/// separately. Where the triangles bound solids (they run along the edge in turn one way and the other) each
/// pair has a solid between it; else those of one component stay together, then those that are folded least.
/// A triangle that is left over, and pairs that no fans can part (both ends of an edge in one fan), keep the
/// edge as it was. No triangle is moved in the list. `uses`: those of the list's edges, before and after.
/// Counts edges_paired and edges_split. O(n log n).
void pair_faces(TriangleList& list, std::vector<EdgeUse>& uses, RepairReport& report);

/// Turns each component of a manifold list outwards: closed ones by their signed volume, unless they are the
/// cavity of another; open ones stay as most of their area was in the file (`turned[t]`: triangle t was
/// turned around against it), and where copies of both directions were dropped the outside is where the
/// surface bulges to. `uses`: those of the list's edges, before.
void turn_outwards(TriangleList& list, const std::vector<EdgeUse>& uses, RepairReport& report,
                   const Context& context);

}  // namespace ridgecraft::mesh
