// SPDX-License-Identifier: GPL-3.0-or-later
// Takes a closed chain that may touch itself apart into simple loops and slits.
#pragma once

#include <vector>

#include "unfold/net/outline.hpp"

namespace ridgecraft::unfold {

/// `loops` bound one connected region, which lies to their left; they may touch themselves and each other,
/// but don't cross by more than `tolerance`. See CutLines for what comes back. O(n log n).
[[nodiscard]] CutLines arrange_cuts(const std::vector<std::vector<Vec2>>& loops, double tolerance);

}  // namespace ridgecraft::unfold
