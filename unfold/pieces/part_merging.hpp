// SPDX-License-Identifier: GPL-3.0-or-later
// Which pieces of a forest are neighbours on the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

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

// After the parts are unfolded: neighbouring pieces, of one part or of several, become one where that is
// easier to build.

/// Replaces two neighbouring pieces by one net of both where there is one without overlap that fits the room
/// and costs less than the two (piece_cost.hpp), the smallest pieces first, until there are no such
/// neighbours. Panels stay whole. Deterministic for one seed but for the deadline.
[[nodiscard]] Folds merge_parts(const NetProblem& problem, const Folds& folds, const Context& context);

}  // namespace ridgecraft::unfold
