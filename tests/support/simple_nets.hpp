// SPDX-License-Identifier: GPL-3.0-or-later
// Nets without a search, for tests of what comes after unfolding.
#pragma once

#include <span>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::test {

/// Unfolds breadth first: one piece for each component, or more where edges are given that must be cut. Faces
/// may overlap unless the shape is simple (every net of a cube, a brick, a tube or a small convex shape is
/// fine). All faces are of part 0 if `part` is empty. A flat vertex inside a piece stays whole. Joins have no
/// tabs.
[[nodiscard]] unfold::Nets simple_nets(const mesh::Surface& surface, std::span<const EdgeId> cuts = {},
                                       const IdVector<FaceId, PartId>& part = {});

}  // namespace ridgecraft::test
