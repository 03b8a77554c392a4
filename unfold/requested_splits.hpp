// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are split because somebody asks for it: until every edge that is wide enough has a tab, and
// until each piece folds with all its creases at once.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// Splits pieces of a clean forest until each folds up with all creases together (folding/fold_order.hpp):
/// each first gets a tree that does, whatever that costs in tabs; where none is found the fold goes that lies
/// between the most pairs of faces that meet on the way. Pieces that fit the room still do. At the deadline
/// nothing is searched any more, but pieces are split all the same. Deterministic for one seed but for the
/// deadline. Throws Error(interrupted).
[[nodiscard]] Folds split_to_fold_together(const NetProblem& problem, const Folds& folds,
                                           const Context& context);

/// What that came to, of finished nets, as notes of theirs: how many pieces were split off, and how many
/// don't fold so all the same.
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
