// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that no knife cuts out stay with a neighbour.
#pragma once

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_wishes.hpp"

namespace ridgecraft::unfold {

/// Flat regions narrower than this can't be cut out and glued, mm.
inline constexpr double needle_mm = 1.0;

/// What is wished for, and that each flat region narrower than needle_mm keeps the longest edge that it
/// shares with another and nobody has a wish for, as long as few are kept together; what lies elsewhere
/// beside it is cut off it, so that nothing hangs on a thread of paper. The wishes as they were where there
/// is no such region. O(n).
[[nodiscard]] EdgeWishes with_needles_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                                           const EdgeWishes& wishes);

}  // namespace ridgecraft::unfold
