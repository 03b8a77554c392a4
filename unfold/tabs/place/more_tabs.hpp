// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs beyond the one that each join has (is_additional): on its other side, and at edges that are glued to
// nothing.
#pragma once

#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/net/tab_choice.hpp"
#include "unfold/tabs/place/tab_wishes.hpp"

namespace ridgecraft::unfold {

/// Gives joins whose wish asks for it a second tab, the mirror image of the first one or what room leaves of
/// it: the two are glued to each other. Where the choice wants them, tabs at borders, too, which have no
/// join. They come after all others, keep clear of them, and are left out on pieces that don't fit the sheet
/// with them. O(n log n) for pieces of bounded size. Throws Error(interrupted).
void add_more_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                   std::span<const TabWish> wishes, const TabChoice& choice, Nets& nets,
                   const Context& context);

}  // namespace ridgecraft::unfold
