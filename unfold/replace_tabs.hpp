// SPDX-License-Identifier: GPL-3.0-or-later
// New tabs on old nets.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/net/tab_choice.hpp"

namespace ridgecraft::unfold {

/// Gives finished nets new joins' numbers and new tabs, as options.tabs, options.sheet and the choice ask;
/// their folds and cuts stay. About O(n log n). Throws Error(interrupted), and Error(unreadable_input) where
/// the choice names an edge or a piece that isn't there.
void replace_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                  Nets& nets, const Context& context, const TabChoice& choice = {});

}  // namespace ridgecraft::unfold
