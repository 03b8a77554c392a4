// SPDX-License-Identifier: GPL-3.0-or-later
// What every set of tabs has to keep, checked by brute force.
#pragma once

#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tree_nets.hpp"

namespace ridgecraft::test {

/// Flat edges become folds before all others, so panels stay whole.
[[nodiscard]] FoldOrder panels_first(const mesh::Surface& surface);

/// Where a point of the tab, x along its base and y away from it, comes to lie on the model.
[[nodiscard]] Vec3 glued(const mesh::Surface& surface, CornerId side, double x, double y);

/// Everything that the contract and unfold/tabs/place/place_tabs.hpp promise.
void check_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const unfold::Nets& nets,
                const unfold::TabOptions& options);

/// The nets with tabs on them.
[[nodiscard]] unfold::Nets with_tabs(const mesh::Surface& surface, const prepare::Panels& panels,
                                     unfold::Nets nets, const unfold::TabOptions& options = {});

}  // namespace ridgecraft::test
