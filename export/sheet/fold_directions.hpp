// SPDX-License-Identifier: GPL-3.0-or-later
// Which way the folds of a piece run: paper folds cleanly along its grain, and cracks across it.
#pragma once

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::paper {

/// Of each piece the direction that its folds have most in common, on its net: the axis of the mean of their
/// doubled angles, each by its length times its fold angle. A unit vector, of either sense; zero where no
/// direction is before others. O(edges).
[[nodiscard]] IdVector<PieceId, Vec2> fold_directions(const mesh::Surface& surface, const unfold::Nets& nets);

}  // namespace ridgecraft::paper
