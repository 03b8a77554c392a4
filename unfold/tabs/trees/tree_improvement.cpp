// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/tree_improvement.hpp"

#include "base/random.hpp"

namespace ridgecraft::unfold {
namespace {

/// Draws between two looks at the clock: some goals take a millisecond for one.
constexpr std::uint64_t draws_per_look = 16;

}  // namespace

bool improve_tree(ChangingNet& net, TreeGoal& goal, std::uint64_t draws, std::uint64_t seed,
                  const Context& context) {
  Random random(seed);
  const Folds given = net.folds();
  bool changed = false;
  for (std::uint64_t i = 0; i < draws && !goal.done(); ++i) {
    if (i % draws_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        break;
      }
    }
    const std::optional<Swap> swap = goal.draw(net, random);
    if (!swap || !net.is_clean(*swap)) {
      continue;
    }
    net.make(*swap);
    if (goal.accepts(net)) {
      net.keep();
      changed = true;
    } else {
      net.take_back();
    }
  }
  if (changed && !net.is_clean()) {
    net.set_tree(given);
    changed = false;
  }
  return changed;
}

}  // namespace ridgecraft::unfold
