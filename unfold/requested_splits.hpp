// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are split because somebody asks for it: until every edge that is wide enough has a tab, and
// until each piece folds with all its creases at once.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/plan.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

// Pieces are split until each folds up with all creases together, where that is the rule.

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

// Pieces are split until every edge that is wide enough has a usable tab, where that is asked for.

struct AllTabs {
  Folds folds;
  Causes causes;                 ///< pieces that were split off are there for tabs
  std::size_t split_pieces = 0;  ///< pieces more than before
  bool in_time = true;           ///< all that was to be tried was
};

/// Whether tabs are wanted on all edges, even at the price of more pieces.
[[nodiscard]] bool wants_all_tabs(const Options& options);

/// Splits pieces of these folds as pieces/tab_split.hpp does; where the time is up already, gives them back
/// as they are. `patch`: whole_patch. Throws Error(interrupted).
[[nodiscard]] AllTabs give_all_tabs(const UnfoldProblem& problem, const Plan& plan, const Patch& patch,
                                    const Folds& folds, const Causes& causes, const Context& context);

/// What that came to, of finished nets, as a note of theirs.
void note_all_tabs(const UnfoldProblem& problem, const AllTabs& split, Nets& nets);

}  // namespace ridgecraft::unfold
