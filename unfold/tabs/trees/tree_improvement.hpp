// SPDX-License-Identifier: GPL-3.0-or-later
// One net, many trees: swaps are drawn and tried, and what is better stays.
#pragma once

#include <cstdint>
#include <optional>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// What a tree is changed for.
class TreeGoal {
 public:
  TreeGoal() = default;
  TreeGoal(const TreeGoal&) = delete;
  TreeGoal& operator=(const TreeGoal&) = delete;
  virtual ~TreeGoal() = default;

  /// The swap to be tried next, whether clean or not; nothing where the draw was in vain.
  [[nodiscard]] virtual std::optional<Swap> draw(ChangingNet& net, Random& random) = 0;
  /// Whether the net is to stay as a clean swap has just made it. What is asked is dear, from the hull
  /// (cheap) to how the tree folds, so what refuses most for the least comes first.
  [[nodiscard]] virtual bool accepts(ChangingNet& net) = 0;
  /// Whether nothing more is to be tried.
  [[nodiscard]] virtual bool done() const { return false; }
};

/// Tries `draws` swaps. False where none stayed, and where the net turned out not to be clean when it was
/// laid out afresh: then it is as it was. Deterministic for one seed but for the deadline.
bool improve_tree(ChangingNet& net, TreeGoal& goal, std::uint64_t draws, std::uint64_t seed,
                  const Context& context);

}  // namespace ridgecraft::unfold
