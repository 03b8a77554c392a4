// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that come after those of the joins, and keep clear of all that stand already.
#pragma once

#include <cstddef>
#include <vector>

#include "base/id.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

class StandingTabs {
 public:
  /// The nets must outlive it; `options` has the clearance.
  StandingTabs(Nets& nets, const TabOptions& options)
      : nets_(nets), clearance_mm_(options.clearance_mm), standing_(nets.pieces.size()) {}

  /// A tab of the nets, and its site.
  void add_standing(const TabSite& site, const Tab& tab);
  /// Gives the nets a tab: the best usable shape within `room` that nothing is in the way of, if there is
  /// one. O(tabs of the piece).
  void place(const TabSite& site, ConvexShape room, const TabOptions& options, Tab tab);

 private:
  /// A tab that stands, on its site.
  struct Standing {
    TabSite site;
    ConvexShape shape;
  };

  Nets& nets_;
  double clearance_mm_;
  IdVector<PieceId, std::vector<Standing>> standing_;
};

/// Tabs from `first` on go from each piece that doesn't fit the sheet with them. O(n log n).
void drop_beyond(const Sheet& sheet, std::size_t first, Nets& nets);

}  // namespace ridgecraft::unfold
