// SPDX-License-Identifier: GPL-3.0-or-later
// The search among the nets of a piece, or of a few neighbouring pieces, for the one of least energy.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/energy/annealing.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

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
