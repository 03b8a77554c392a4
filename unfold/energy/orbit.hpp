// SPDX-License-Identifier: GPL-3.0-or-later
// The orbit of a move: with it go its images, so that a forest stays as symmetric as its model.
#pragma once

#include <vector>

#include "unfold/energy/cut_costs.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/forest.hpp"

namespace ridgecraft::unfold {

/// Sets `orbit` to a move, then its images and theirs (CutCosts::images), each without what is so already; no
/// two open or close the same edge. Images that an edge of the move has none of are left out. Where there are
/// more than 64 the move is alone. O(moves^2).
void find_orbit(const Move& move, const Patch& patch, const CutCosts& costs, std::vector<Move>& orbit);

}  // namespace ridgecraft::unfold
