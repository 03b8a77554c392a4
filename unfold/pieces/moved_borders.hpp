// SPDX-License-Identifier: GPL-3.0-or-later
// Where a part has no single net, the borders around it move until it has one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

struct MovedBorders {
  Folds folds;
  std::vector<PartId> parts;  ///< that have a piece less, once for each piece
};

/// A part that has pieces because its nets overlap, or because it has more flat regions than a piece may
/// have, is unfolded anew together with pieces of its neighbours, one piece fewer than before, until nothing
/// is left to save: a small piece is laid against a neighbour's net as both are, where that is possible at
/// the least cost; else two pieces become one, or more of them linked trees (patch.hpp), which are
/// searched for a net (heated_search.hpp) and, where they don't fit the room, for borders at which they do
/// (energy/anneal.hpp). What is proven to need as many pieces isn't tried (least_forest.hpp). The forest stays
/// clean and what fits still fits. `cause`: of each face why its piece is none with the others of its part,
/// PieceReason::part for the one that stands for it. The searches' work
/// is bounded: a second or two, more where a hundred parts have no net, since what is
/// found is compared beside it. Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] MovedBorders move_borders(const NetProblem& problem, const Folds& folds,
                                        std::span<const PieceReason> cause, const Context& context);

}  // namespace ridgecraft::unfold
