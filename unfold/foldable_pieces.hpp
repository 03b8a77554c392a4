// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that nobody could fold without bending faces aside are split.
#pragma once

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

/// Splits those pieces for which no order of folding is found (folding/fold_order.hpp) as
/// pieces/linear_split.hpp does; what is split off has the reason PieceReason::shape in `causes`. `patch`:
/// whole_patch. One piece is one task. Throws Error(interrupted).
[[nodiscard]] Folds with_foldable_pieces(const Asked& asked, const Plan& plan, const Patch& patch,
                                         const Folds& folds, Causes& causes, const Context& context);

}  // namespace ridgecraft::unfold
