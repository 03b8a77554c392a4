// SPDX-License-Identifier: GPL-3.0-or-later
// Strips of flat regions that go round: the walls of turned, conical, prismatic and tubular places.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Four-sided flat regions in a row, five or more, each of which meets the next along the whole of a side,
/// the rung. Somebody who draws nets leaves such a wall one strip, closed by one seam.
struct Band {
  std::vector<std::uint32_t> rungs;  ///< a side of the patch for each of its edges; one rung may be several
  bool closed = false;               ///< it goes all the way round; else half of it at least, bent one way
  double mean_rung_mm = 0.0;
  double mean_rim_mm = 0.0;  ///< what its regions have on average of a rim
};

/// A region belongs to one band at most: of two that cross, as on a ring with a round section, the one with
/// the longer rungs counts. Edges of a rung may go on straight, as where flat regions have corners of others
/// at their sides. The one with the longest rungs comes first. O(n log n).
[[nodiscard]] std::vector<Band> find_bands(const Patch& patch);

}  // namespace ridgecraft::unfold
