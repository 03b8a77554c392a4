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
  /// Swaps that are looked at afterwards with the tabs as they are, none with a new overlap.
  std::uint64_t exact_trials = 0;
};

/// The trials for a net of so many faces of which each is worth `trials_per_face` (Options): fewer for each
/// where there are many.
[[nodiscard]] Annealing annealing_for(double trials_per_face, std::uint32_t faces);

/// What a net knows of its sides, without mirror images. It must outlive the result.
[[nodiscard]] CutFacts cut_facts(const ChangingNet& net, const TabOptions& options);

/// Brings the net to a tree of less energy (NetEnergy) by simulated annealing over swaps of a cut and a fold.
/// All its trees stay clean and fit the room if it does. Deterministic for one seed but for the deadline.
/// Throws Error(interrupted).
void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
