// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces are split until each folds up with all creases together, where that is the rule.
#pragma once

#include <string>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

struct LinearFolding {
  Folds folds;
  Causes causes;     ///< pieces that were split off are there for folding
  std::string note;  ///< how many there are
};

/// Splits pieces of these folds as pieces/linear_split.hpp does. `patch`: whole_patch. Throws Error(interrupted).
[[nodiscard]] LinearFolding fold_together(const Plan& plan, const Patch& patch, Folds folds, Causes causes,
                                          const Context& context);

/// Pieces that don't fold so all the same, of finished nets, as a note of theirs; none where there are none.
void note_not_linear(Nets& nets);

}  // namespace ridgecraft::unfold
