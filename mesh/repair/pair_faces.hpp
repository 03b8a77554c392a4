// SPDX-License-Identifier: GPL-3.0-or-later
// Which two of the many faces at an edge belong together. Private to mesh/.
#pragma once

#include <vector>

#include "mesh/model/repair_report.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Divides edges with more than two triangles among pairs of these, by giving points to the fans around them
/// separately. Where the triangles bound solids (they run along the edge in turn one way and the other) each
/// pair has a solid between it; else those of one component stay together, then those that are folded least.
/// A triangle that is left over, and pairs that no fans can part (both ends of an edge in one fan), keep the
/// edge as it was. No triangle is moved in the list. `uses`: those of the list's edges, before and after.
/// Counts edges_paired and edges_split. O(n log n).
void pair_faces(TriangleList& list, std::vector<EdgeUse>& uses, RepairReport& report);

}  // namespace ridgecraft::mesh
