// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs by which bodies are glued onto others that they stand on.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/net/tab_choice.hpp"

namespace ridgecraft::unfold {

/// Gives each side of a foot (tabs/place/feet.hpp) that has no tab yet one that is folded inwards and lies
/// within the foot's opening, where there is room. They come after all other tabs and keep clear of these;
/// pieces that don't fit the sheet with them get none. None where no tabs are wanted, or none at feet
/// (TabOptions). Heights and angles are those of the choice. O(n log n), and the square of a piece's tabs.
/// Throws Error(interrupted).
void add_foot_tabs(const mesh::Surface& surface, const Options& options, const TabChoice& choice, Nets& nets,
                   const Context& context);

}  // namespace ridgecraft::unfold
