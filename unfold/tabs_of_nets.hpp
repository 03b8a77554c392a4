// SPDX-License-Identifier: GPL-3.0-or-later
// The tabs of finished nets: where they may be, then which of them the sheet holds.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// Which tabs nets get.
struct TabTask {
  const mesh::Surface& surface;
  const prepare::Panels& panels;
  const Options& options;
  TabChoice choice = {};
};

/// Numbers the joins of these nets and gives them tabs as the options say, each body by itself, whatever
/// others are its equals, then as a choice says that asks for anything. Tabs that were
/// there are lost. Throws Error(interrupted), and Error(unreadable_input) as tab_requests().
void give_tabs(const TabTask& task, Nets& nets, const Context& context);

// New tabs on old nets.

/// Gives finished nets new joins' numbers and new tabs, as options.tabs, options.sheet and the choice ask;
/// their folds and cuts stay. About O(n log n). Throws Error(interrupted), and Error(unreadable_input) where
/// the choice names an edge or a piece that isn't there.
void replace_tabs(const TabTask& task, Nets& nets, const Context& context);

// Tabs by which bodies are glued onto others that they stand on.

/// Gives each side of a base (tabs/place/sites.hpp) that has no tab yet one that is folded inwards and lies
/// within the base's opening, where there is room. They come after all other tabs and keep clear of these;
/// pieces that don't fit the sheet with them get none. None where no tabs are wanted, or none at bases
/// (TabOptions). Heights and angles are those of the choice. O(n log n), and the square of a piece's tabs.
/// Throws Error(interrupted).
void add_base_tabs(const mesh::Surface& surface, const Options& options, const TabChoice& choice, Nets& nets,
                   const Context& context);

}  // namespace ridgecraft::unfold
