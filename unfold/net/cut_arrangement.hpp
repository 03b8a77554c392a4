// SPDX-License-Identifier: GPL-3.0-or-later
// Takes a closed chain that may touch itself apart into simple loops and slits.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::unfold {

/// What the knife follows, each line once.
struct CutLines {
  /// Simple closed polygons that don't share a stretch: the outer one first (counterclockwise), then holes
  /// (clockwise), both of the patch and of the plane where the piece runs around a gap and touches itself.
  /// Two of them may share single corners.
  std::vector<std::vector<Vec2>> loops;
  /// Open lines inside the piece where two parts of its outline lie on each other.
  std::vector<std::vector<Vec2>> slits;
};

/// `loops` bound one connected region, which lies to their left; they may touch themselves and each other,
/// but don't cross by more than `tolerance`. See CutLines for what comes back. O(n log n).
[[nodiscard]] CutLines arrange_cuts(const std::vector<std::vector<Vec2>>& loops, double tolerance);

}  // namespace ridgecraft::unfold
