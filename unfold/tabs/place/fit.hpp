// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that make a piece too large for the sheet.
#pragma once

#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/tab_wishes.hpp"

namespace ridgecraft::unfold {

/// Brings the tabs of each piece that fits the sheet without them, but not with them, onto the sheet: it is
/// laid so that most of its tabs are on it or have paper on the other side (tab_rooms.hpp), and all tabs are
/// placed afresh, those of that piece inside the sheet: lower, or from the other side of their join. What
/// finds no place says so (NoTab::beyond_sheet). `nets` has the tabs of place_tabs. O(pieces h^2) where all
/// fit. Throws Error(interrupted).
void fit_tabs_to_sheet(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options,
                       const Sheet& sheet, Nets& nets, const Context& context,
                       std::span<const TabWish> wishes = {});

}  // namespace ridgecraft::unfold
