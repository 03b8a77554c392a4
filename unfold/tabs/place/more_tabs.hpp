// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs beyond the one that each join has (is_additional): on its other side, and at edges that are glued to
// nothing.
#pragma once

#include <optional>

#include "base/context.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {

/// Gives joins whose request asks for it a second tab, the mirror image of the first one or what room leaves
/// of it: the two are glued to each other. Where the choice wants them, tabs at borders, too, which have no
/// join. They come after all others, keep clear of them, and are left out on pieces that don't fit the sheet
/// with them. O(n log n) for pieces of bounded size. Throws Error(interrupted).
void add_more_tabs(const TabProblem& problem, const std::optional<Sheet>& sheet, const TabChoice& choice,
                   Nets& nets, const Context& context);

}  // namespace ridgecraft::unfold
