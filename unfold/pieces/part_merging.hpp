// SPDX-License-Identifier: GPL-3.0-or-later
// After the parts are unfolded: neighbouring pieces, of one part or of several, become one where that is
// easier to build.
#pragma once

#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// Replaces two neighbouring pieces by one net of both where there is one without overlap that fits the room
/// and costs less than the two (piece_cost.hpp), the smallest pieces first, until there are no such
/// neighbours. Panels stay whole. Deterministic for one seed but for the deadline.
[[nodiscard]] Folds merge_parts(const NetProblem& problem, const Folds& folds, const Context& context);

}  // namespace ridgecraft::unfold
