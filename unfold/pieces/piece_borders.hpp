// SPDX-License-Identifier: GPL-3.0-or-later
// Which pieces of a forest are neighbours on the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

struct PieceBorder {
  std::uint32_t a = 0, b = 0;  ///< two pieces, a < b
  double length = 0.0;         ///< of the cut between them, mm
  double smaller_area = 0.0;   ///< of the smaller of the two, mm2
};

/// Neighbouring pieces in the order in which it is worth trying to join them: the smallest piece first, among
/// its neighbours the one with the longest border. `piece`: of each face. O(n log n).
[[nodiscard]] std::vector<PieceBorder> piece_borders(const Patch& patch,
                                                     std::span<const std::uint32_t> piece);

}  // namespace ridgecraft::unfold
