// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are split because somebody asks for it, so that every edge that is wide enough has a tab and
// each piece folds with all its creases at once; and what is said of them.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// What PieceRules::fold_linear came to, of finished nets, as notes of theirs: how many pieces were split
/// off, and how many don't fold so all the same.
void note_linear_folding(std::size_t split_pieces, Nets& nets);

/// Splits pieces of these folds as pieces/tab_split.hpp does, until every edge that is wide enough has a
/// usable tab; where the time is up already, gives them back as they are. `constraints`:
/// Plan::possible_constraints. Throws Error(interrupted).
[[nodiscard]] Folds give_all_tabs(const UnfoldProblem& problem, const NetProblem& nets,
                                  const EdgeConstraints& constraints, const Folds& folds,
                                  const Context& context);

struct AllTabs {
  std::size_t split_pieces = 0;  ///< pieces that are there for tabs
  bool in_time = true;           ///< all that was to be tried was
};

/// What that came to, of finished nets, as a note of theirs.
void note_all_tabs(const UnfoldProblem& problem, const AllTabs& split, Nets& nets);

}  // namespace ridgecraft::unfold
