// SPDX-License-Identifier: GPL-3.0-or-later
// How deep each vertex of a valley lies under its bridge (docs/design/segmentation.md, "Depth of a valley").
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::segment {

/// The valley in the plane of its bridge: x = t, position along the bridge; y = h, distance to the bridge's
/// segment. The first point is (0, 0), the last (length of the bridge, 0).
void project_valley(std::span<const Vec3> valley, std::vector<Vec2>& chain);

/// Concavity of each vertex of a chain (t, h) as project_valley makes it: h where t never falls; else the
/// shortest path to the bridge inside the polygon of chain and bridge; else, where that polygon meets itself,
/// the sum of distances down a hierarchy of bridges. O(n) for the first, O(n^2) typically for the second.
void chain_concavity(std::span<const Vec2> chain, std::vector<double>& concavity);

}  // namespace ridgecraft::segment
