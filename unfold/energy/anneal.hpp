// SPDX-License-Identifier: GPL-3.0-or-later
// How long and how hot the search for a net of less energy is.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "base/elementary.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

struct Annealing {
  /// Swaps that are tried with tabs told by angles, overlaps allowed on the way.
  std::uint64_t quick_trials = 0;
  /// Swaps that are looked at afterwards with the tabs as they are, none with a new overlap.
  std::uint64_t exact_trials = 0;
  /// A swap that costs d, mm, is taken with probability exp(-d / heat): heat at the beginning.
  double first_heat = 20.0;
  /// The quick half ends with the first clean net that fits the room and costs less than the one given.
  bool until_it_fits = false;
};

/// The trials for a net of so many faces of which each is worth `trials_per_face` (Options): fewer for each
/// where there are many.
[[nodiscard]] Annealing annealing_for(double trials_per_face, std::uint32_t faces);

/// A value between two, in equal ratios for equal steps of `share` from 0 to 1.
[[nodiscard]] inline double between(double first, double last, double share) {
  return first * elementary::pow(last / first, share);
}

// The search among the nets of a piece, or of a few neighbouring pieces, for the one of least energy.

/// What a net knows of its sides, without mirror images. It must outlive the result.
[[nodiscard]] CutFacts cut_facts(const ChangingNet& net, const TabOptions& options);
/// The same of a patch whose tabs are looked at, whatever its tree is.
[[nodiscard]] CutFacts cut_facts(const TabState& tabs, const TabOptions& options);

/// Brings the net to a tree of less energy (NetEnergy) by simulated annealing over swaps of a cut and a fold:
/// a quick half, and an exact one where there are tabs and trials for it; then mirror images count twice in
/// the first. All its trees stay clean and fit the room if it does. Deterministic for one seed but for the
/// deadline. Throws Error(interrupted).
void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context);

/// The same among the trees of one piece that fold up with all creases together (folding_meetings.hpp). False
/// where it came to none: the net is as it was then.
bool anneal_folding_together(ChangingNet& net, const CutFacts& facts, const Room& room,
                             const Weights& weights, const Annealing& rules, std::uint64_t seed,
                             const Context& context);

}  // namespace ridgecraft::unfold
