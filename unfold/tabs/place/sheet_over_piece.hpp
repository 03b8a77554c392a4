// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sheet is laid over pieces that are nearly as large, so that few joins lose their tabs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

/// Gives each piece that doesn't fit the sheet with its tabs, but does without, a room, and chooses all rooms
/// so that few tabs lie outside, least of all such as have no paper on the other side of their join. `rooms`
/// has a place for each piece. False when no piece needed one. O(passes * rooms * turns * tabs).
[[nodiscard]] bool add_rooms(const Sheet& sheet, const TabOptions& options, const std::vector<TabSite>& sites,
                             const Nets& nets, std::span<std::optional<TabRoom>> rooms);

}  // namespace ridgecraft::unfold
