// SPDX-License-Identifier: GPL-3.0-or-later
// What a user's choice of tabs (net/options.hpp) means for each join.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// How one join's tab is to be.
struct TabRequest {
  bool wanted = true;
  bool second = false;               ///< a tab on the other side, too (more_tabs.hpp)
  std::optional<std::uint8_t> side;  ///< of Surface::sides(edge): 0 or 1, from which it grows
  bool no_other_side = false;        ///< rather no tab than one on the other side
  bool slot = false;                 ///< to be put into a slit (slot_tabs.hpp), with the height for it
  TabOptions options;                ///< its height and angle
};

/// What is asked for numbers, told of the edges that have them in these nets, so that it outlives the
/// numbers; of what is asked for one number the last counts. Throws Error(unreadable_input) as
/// tab_requests(). O(n log n).
[[nodiscard]] std::vector<TabAt> by_edges(const mesh::Surface& surface, const Nets& nets,
                                          const std::vector<EdgeTab>& asked);

/// Height and angle of tabs on edges of this length.
[[nodiscard]] TabOptions options_for(const TabOptions& options, const TabChoice& choice, double length_mm);

/// As high as the highest tab that is asked for: for what may lie in the way of any of them.
[[nodiscard]] TabOptions with_greatest_height(TabOptions options, std::span<const TabRequest> requests);

/// As high as the highest tab of any edge, by the choice for all of them.
[[nodiscard]] TabOptions with_greatest_height(TabOptions options, const TabChoice& choice);

/// One for each join. With TabSides::one_side the nets have tabs already: along a seam of two pieces, those
/// tell which of them gives more of it. Throws Error(unreadable_input) where a number belongs to no join, or
/// a piece to none of its sides; the message says who asked. O(n log n).
[[nodiscard]] std::vector<TabRequest> tab_requests(const mesh::Surface& surface, const Nets& nets,
                                                   const TabOptions& options, const TabChoice& choice);

}  // namespace ridgecraft::unfold
