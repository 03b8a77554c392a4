// SPDX-License-Identifier: GPL-3.0-or-later
// The nets that the search for pieces begins with: clean, and of a size to fit the sheet.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// How nets are begun with.
struct StartRules {
  double tolerance = 0.0;                               ///< of overlap, mm
  PanelCuts panel_cuts = PanelCuts::only_if_too_large;  ///< where one net is searched for
  /// Whether one net is searched for first.
  bool one_net = false;
};

/// A forest of a patch without overlap whose trees fit the room: edges become folds, the longest first (J.
/// Kruskal 1956), where that joins two trees to one that does; with `one_net` those of the best net first.
/// What frozen sides hold together must fit by itself. O(n log n) but for the search for one net.
/// Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] Folds start_nets(const Patch& patch, const Room& room, const StartRules& rules,
                               std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
