// SPDX-License-Identifier: GPL-3.0-or-later
// Closed strips of flat regions: the walls of turned, conical, prismatic and tubular places.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Bands of a patch: closed rings of five or more four-sided flat regions, or of twice as many triangles that
/// point up and down by turns, each of which meets the next along the
/// whole of a side, the rung. Somebody who
/// draws nets leaves such a ring one strip, closed by one seam.
struct Bands {
  std::vector<std::uint32_t> band;   ///< per side: the band that its edge is a rung of, or nothing
  std::vector<double> seam_mm;       ///< per band: its longest rung, 0 where it has two ends
  std::vector<std::uint8_t> closed;  ///< per band: 0 where it has two ends
  std::vector<double> mean_rung_mm;  ///< per band
  std::vector<double> mean_rim_mm;   ///< per band: what its regions have on average of a rim

  [[nodiscard]] bool empty() const { return seam_mm.empty(); }
};

/// A region belongs to one band at most: of two that cross, as on a ring with a round section, the one with
/// the longer rungs counts. Edges of a rung may go on
/// straight, as where flat regions have corners of others at their sides. O(n log n).
[[nodiscard]] Bands find_bands(const Patch& patch);

}  // namespace ridgecraft::unfold
