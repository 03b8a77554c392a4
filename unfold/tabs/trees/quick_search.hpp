// SPDX-License-Identifier: GPL-3.0-or-later
// The first, quick half of the search for tabs: rated by angles alone, overlap allowed on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/context.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/tabs/trees/corner_room.hpp"

namespace ridgecraft::unfold {

/// Improves the net's tree by simulated annealing over swaps of a cut and a fold: the cost is
/// wedges.missing() and a price on each overlap, which rises. Returns the tree of least missing() among those
/// without overlap (deeper than `tolerance`, mm) that are `allowed` (if given); nothing where there was none.
/// Deterministic for one seed but for the context's deadline. About 0.001 ms per trial at 500 faces. Throws
/// Error(interrupted).
[[nodiscard]] std::optional<Folds> find_tab_start(const Patch& patch, TabWedges& wedges, RootedNet& net,
                                                  double tolerance, std::uint64_t trials,
                                                  const std::function<bool(const Folds&)>& allowed,
                                                  std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
