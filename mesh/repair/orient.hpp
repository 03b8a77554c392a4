// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles become an oriented manifold surface. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/soup.hpp"
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

}  // namespace ridgecraft::mesh
