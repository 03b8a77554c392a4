// SPDX-License-Identifier: GPL-3.0-or-later
// Two nets laid against each other as they are.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "unfold/net/piece_rules.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

struct NetsToJoin {
  std::size_t parts = 1;                                       ///< of how many parts the two have faces
  double tolerance = 0.0;                                      ///< mm
  double most_cost = std::numeric_limits<double>::infinity();  ///< what the one may cost (piece_cost.hpp)
};

/// The patch of two pieces and its two trees: the tree that a fold over one of the longest cuts between them
/// makes, without overlap and such that it fits the room, the cheapest of those below most_cost. `work` is
/// the number of faces that may be laid flat, and is taken down by those that were.
[[nodiscard]] std::optional<Folds> join_as_they_are(const Patch& both, const Folds& apart, const Room& room,
                                                    const Weights& weights, const NetsToJoin& rules,
                                                    std::size_t& work);

}  // namespace ridgecraft::unfold
