// SPDX-License-Identifier: GPL-3.0-or-later
// The first and by far the most collapses of a model of very many faces. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// Collapses by small quadric error (M. Garland, P. Heckbert: Surface simplification using quadric error
/// metrics, SIGGRAPH 1997), in passes: each puts its edges in order once, and goes through them. Ten to
/// twenty times faster than one queue of all edges, and hardly worse as long as faces are much smaller than
/// anything that matters. Points of the border, of walls and of mirror planes stay as they are. No point
/// comes to lie farther than `farthest` from the planes of the faces that went for it, in the mean of their
/// squares. Ends at `faces` faces, which are counted in the whole, or where a pass finds next to nothing. The
/// domain's faces must fulfil mesh::Surface's invariants, and so does the result. O(n log n).
[[nodiscard]] std::vector<Collapse> quick_collapses(const FundamentalDomain& domain, const Walls& walls,
                                                    std::size_t faces, double farthest,
                                                    const Context& context);

}  // namespace ridgecraft::prepare
