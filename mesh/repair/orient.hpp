// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles become an oriented manifold surface. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/repair_report.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Makes the invariants of Surface true: edges get at most two triangles, which run along them in opposite
/// directions, and vertices one fan, by giving points to several of their triangles separately and turning
/// triangles around. No triangle is dropped or moved in the list. Uses CGAL's polygon-soup orientation where
/// something is wrong. `uses`: those of the list's edges, before and after. O(n log n).
void make_manifold(TriangleList& list, std::vector<EdgeUse>& uses, RepairReport& report,
                   const Context& context);

/// Are the invariants of Surface true (points without triangles apart)? O(n log n).
[[nodiscard]] bool is_manifold(const TriangleList& list);

/// Turns each component of a manifold list outwards: closed ones by their signed volume, unless they are the
/// cavity of another; open ones stay as most of their area was in the file (`turned[t]`: triangle t was
/// turned around against it), and where copies of both directions were dropped the outside is where the
/// surface bulges to. `uses`: those of the list's edges, before.
void turn_outwards(TriangleList& list, const std::vector<EdgeUse>& uses, RepairReport& report,
                   const Context& context);

}  // namespace ridgecraft::mesh
