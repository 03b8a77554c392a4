// SPDX-License-Identifier: GPL-3.0-or-later
// The search among the nets of a piece, or of a few neighbouring pieces, for the one of least energy.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

struct Annealing {
  /// Swaps that are tried with tabs told by angles, overlaps allowed on the way.
  std::uint64_t quick_trials = 0;
  /// Swaps that are tried afterwards with the tabs as they are, none with a new overlap.
  std::uint64_t exact_trials = 0;
  /// A swap that costs d, mm, is taken with probability exp(-d / heat).
  double first_heat = 20.0;
  double middle_heat = 0.5;  ///< where the quick search ends
  double exact_heat = 2.0;   ///< where the exact one begins
  double last_heat = 0.3;
};

/// Brings the net to a tree of less energy (NetEnergy) by simulated annealing over swaps of a cut and a fold.
/// All its trees stay clean and fit the room if it does. Deterministic for one seed but for the deadline.
/// Throws Error(interrupted).
void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
