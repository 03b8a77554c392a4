// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/standing_tabs.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/geometry.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/fit.hpp"

namespace ridgecraft::unfold {

void StandingTabs::add_standing(const TabSite& site, const Tab& tab) {
  const std::vector<Vec2> ground = tab.slit ? convex_hull(tab.polygon) : tab.polygon;
  standing_[site.piece].push_back({site, site.own.in(ConvexShape(std::span<const Vec2>(ground)))});
}

void StandingTabs::place(const TabSite& site, ConvexShape room, const TabOptions& options, Tab tab) {
  for (const Obstacle& obstacle : site.obstacles) {
    room = room.empty() ? room : trimmed(room, obstacle, clearance_mm_);
  }
  for (const Standing& other : standing_[site.piece]) {
    room = room.empty() ? room : trimmed(room, tab_as_obstacle(site, other.site, other.shape), clearance_mm_);
  }
  for (const TabShape& shape : tab_shapes(room, site.length, options)) {
    const bool clear = std::ranges::all_of(standing_[site.piece], [&](const Standing& other) {
      return tabs_clear(site, shape.outline, other.site, other.shape, clearance_mm_);
    });
    if (clear) {
      const ConvexShape placed = site.own.out(shape.outline);
      tab.side = site.side;
      tab.polygon.assign(placed.begin(), placed.end());
      nets_.tabs.push_back(std::move(tab));
      standing_[site.piece].push_back({site, shape.outline});
      return;
    }
  }
}

void drop_beyond(const Sheet& sheet, std::size_t first, Nets& nets) {
  IdVector<TabId, std::uint8_t> keep(nets.tabs.size(), 1);
  const TabsOfPiece tabs = tabs_of_pieces(nets);
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    if (!fits_with(nets, piece, tabs[piece], sheet)) {
      for (const TabId t : tabs[piece]) {
        keep[t] = t.value() < first ? 1 : 0;
      }
    }
  }
  keep_only(keep, nets);
}

}  // namespace ridgecraft::unfold
