// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces are split until each folds up with all creases together, where that is the rule.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

struct LinearFolding {
  Folds folds;
  Causes causes;                 ///< pieces that were split off are there for folding
  std::size_t split_pieces = 0;  ///< how many there are
};

/// Splits pieces of these folds as pieces/linear_split.hpp does. `patch`: whole_patch. Throws
/// Error(interrupted).
[[nodiscard]] LinearFolding fold_together(const Plan& plan, const Patch& patch, const Folds& folds,
                                          Causes causes, const Context& context);

/// What that came to, of finished nets, as notes of theirs: how many pieces were split off, and how many
/// don't fold so all the same.
void note_linear_folding(std::size_t split_pieces, Nets& nets);

}  // namespace ridgecraft::unfold
