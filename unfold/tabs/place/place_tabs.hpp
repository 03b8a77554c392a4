// SPDX-License-Identifier: GPL-3.0-or-later
// Glue tabs on finished nets. docs/design/tabs.md has the method.
#pragma once

#include <optional>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/tab_requests.hpp"

namespace ridgecraft::unfold {

/// Where the tabs of a piece have to stay: seen in its plane turned by `angle` (radians, counterclockwise).
struct TabRoom {
  double angle = 0.0;
  Box2 box;
};

/// Where tabs go, and how they are to be.
struct TabProblem {
  const mesh::Surface& surface;
  const prepare::Panels& panels;
  const TabOptions& options;
  std::span<const TabRequest> requests = {};  ///< by join, or none at all
  std::span<const std::optional<TabRoom>> rooms =
      {};  ///< by piece, or none: keep tabs off the rest of its plane
};

/// Gives every join a tab where one fits, and the reason where none does; replaces all tabs that were there.
/// A tab keeps options.clearance_mm from every face and tab of its piece (less only within corner_zone_mm of
/// a corner that they share, see shapes.hpp) and lies, folded over, inside the flat region that it is
/// glued behind. It grows from the side with the smaller flat region, unless only the other one has room. In
/// this order a tab is made lower, steeper, trimmed, moved to the other side, put on a part of the edge, made
/// smaller than useful, left out. Deterministic, independent of how a piece lies in its plane up to rounding;
/// about O(n log n). When the context's deadline and grace have passed,
/// joins keep what they have by then: their first choice, or nothing (NoTab::time_up). Throws
/// Error(interrupted).
void place_tabs(const TabProblem& problem, Nets& nets, const Context& context);

/// Is a tab at least usable_height_mm (shapes.hpp) high along at least half of its edge, or put into a slit?
/// O(1).
[[nodiscard]] bool is_usable(const mesh::Surface& surface, const Nets& nets, TabId tab,
                             const TabOptions& options);

/// How many joins have a usable tab: `tabs_usable` in reports. O(tabs).
[[nodiscard]] std::size_t tabs_usable(const mesh::Surface& surface, const Nets& nets,
                                      const TabOptions& options);

}  // namespace ridgecraft::unfold
