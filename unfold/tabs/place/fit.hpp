// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that make a piece too large for the sheet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

/// The tabs that grow from each piece, ascending.
using TabsOfPiece = IdVector<PieceId, std::vector<TabId>>;
[[nodiscard]] TabsOfPiece tabs_of_pieces(const Nets& nets);

/// Whether a piece with these of its tabs fits the sheet. O(n log n) in its faces and these tabs.
[[nodiscard]] bool fits_with(const Nets& nets, PieceId piece, std::span<const TabId> tabs,
                             const Sheet& sheet);

/// Keeps the tabs marked by other than 0, with new numbers; a join that loses its own says that it would be
/// beyond the sheet. O(n).
void keep_only(const IdVector<TabId, std::uint8_t>& keep, Nets& nets);

/// Brings the tabs of each piece that fits the sheet without them, but not with them, onto the sheet: it is
/// laid so that most of its tabs are on it or have paper on the other side, and all tabs are
/// placed again, those of that piece inside the sheet: lower, or from the other side of their join. What
/// finds no place says so (NoTab::beyond_sheet). `nets` has the tabs of place_tabs. O(pieces h^2) where all
/// fit. Throws Error(interrupted).
void fit_tabs_to_sheet(const TabProblem& problem, const Sheet& sheet, Nets& nets, const Context& context);

// Tabs that come after those of the joins, and keep clear of all that stand already.

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
