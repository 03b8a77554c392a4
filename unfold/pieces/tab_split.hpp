// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are split so that every edge that is wide enough has a tab.
#pragma once

#include <functional>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// The nets of a forest with all their tabs, as they will be returned.
using NetsOf = std::function<Nets(const Folds&)>;

/// Cuts pieces of a clean forest until every join that can has a usable tab. For each join without one, all
/// folds are tried between it and what lies near it, with the tabs as they are then, and the one that leaves
/// the fewest joins without a tab is cut. Where none is enough, the flat region beside the join is cut off,
/// one fold a round. Single flat regions stay whole, all pieces fit the room. Every tab that is counted was
/// placed by place_tabs. Ends at the deadline with what it has. O(joins without a tab * folds nearby), each
/// with the faces near the smaller half. Throws Error(interrupted).
[[nodiscard]] Folds split_for_tabs(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of,
                                   const Context& context);

}  // namespace ridgecraft::unfold
