// SPDX-License-Identifier: GPL-3.0-or-later
// A piece with other folds and the same faces: shorter cuts, less waste, fewer thin branches.
#pragma once

#include <cstdint>
#include <functional>

#include "mesh/foundation/context.hpp"
#include "unfold/piece_rules.hpp"
#include "unfold/search/patch.hpp"

namespace ridgecraft::unfold {

/// Exchanges folds of a clean net for cuts as long as that lowers its cost (objective.hpp), makes no overlap
/// deeper than `tolerance` (mm), and `allowed` says yes to the tree: trials in proportion to its faces, about
/// 0.1 ms each for a hundred of them. Deterministic for one seed but for the deadline.
[[nodiscard]] Folds tidy_piece(const Patch& piece, const Folds& tree,
                               const std::function<bool(const Folds&)>& allowed, const Weights& weights,
                               double tolerance, std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
