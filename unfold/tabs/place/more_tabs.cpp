// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/more_tabs.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/convex_hull.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/even_tabs.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {
namespace {

/// A tab that stands, on its site.
struct Standing {
  TabSite site;
  ConvexShape shape;
};

class MoreTabs {
 public:
  MoreTabs(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options,
           std::span<const TabWish> wishes, Nets& nets, const Context& context)
      : surface_(surface), nets_(nets), options_(options), wishes_(wishes), standing_(nets.pieces.size()) {
    // What is glued to another tab may be larger than the face behind it.
    options_.inside_target = false;
    sites_ = find_tab_sites(surface, panels, nets, with_greatest_height(options_, wishes), context);
    for (const Tab& tab : nets.tabs) {
      const std::size_t even = std::size_t{2} * tab.join.value();
      const TabSite& site = sites_[tab.side == sites_[even].side ? even : even + 1];
      const std::vector<Vec2> ground = tab.slit ? convex_hull(tab.polygon) : tab.polygon;
      standing_[site.piece].push_back({site, site.own.in(ConvexShape(std::span<const Vec2>(ground)))});
    }
  }

  void add_seconds() {
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const Join& join = nets_.joins[j];
      if (!wishes_[j.value()].second || !join.tab.valid() || nets_.tabs[join.tab].slit) {
        continue;
      }
      const std::size_t even = std::size_t{2} * j.value();
      const std::size_t first = even + (nets_.tabs[join.tab].side == sites_[even].side ? 0 : 1);
      const TabSite& own = sites_[first];
      const TabSite& other = sites_[first ^ 1U];
      const ConvexShape shape = own.own.in(ConvexShape(std::span<const Vec2>(nets_.tabs[join.tab].polygon)));
      add(other, turned_over(shape, other.length), wishes_[j.value()].options, j);
    }
  }

  void add_borders(const TabChoice& choice, const Context& context) {
    TabOptions highest = options_;
    for (const FromLength& step : choice.heights_mm) {
      highest.height_mm = std::max(highest.height_mm, step.value);
    }
    for (const TabSite& site : find_border_sites(surface_, nets_, highest, context)) {
      const TabOptions own = options_for(options_, choice, surface_.length(surface_.edge(site.side)));
      add(site, largest_tab({0.0, site.length, site.length}, site.obstacles, own, TabNeed::usable), own,
          JoinId());
    }
  }

 private:
  /// The best usable shape within `room` that nothing is in the way of.
  void add(const TabSite& site, ConvexShape room, const TabOptions& options, JoinId join) {
    for (const Obstacle& obstacle : site.obstacles) {
      room = room.empty() ? room : trimmed(room, obstacle, options_.clearance_mm);
    }
    for (const Standing& other : standing_[site.piece]) {
      room = room.empty()
                 ? room
                 : trimmed(room, tab_as_obstacle(site, other.site, other.shape), options_.clearance_mm);
    }
    for (const TabShape& shape : tab_shapes(room, site.length, options)) {
      const bool clear = std::ranges::all_of(standing_[site.piece], [&](const Standing& other) {
        return tabs_clear(site, shape.outline, other.site, other.shape, options_.clearance_mm);
      });
      if (clear) {
        const ConvexShape placed = site.own.out(shape.outline);
        nets_.tabs.push_back({site.side, join, std::vector<Vec2>(placed.begin(), placed.end())});
        standing_[site.piece].push_back({site, shape.outline});
        return;
      }
    }
  }

  const mesh::Surface& surface_;
  Nets& nets_;
  TabOptions options_;
  std::span<const TabWish> wishes_;  // of each join
  std::vector<TabSite> sites_;
  IdVector<PieceId, std::vector<Standing>> standing_;
};

/// Tabs from `first` on go from each piece that doesn't fit the sheet with them.
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

}  // namespace

void add_more_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                   std::span<const TabWish> wishes, const TabChoice& choice, Nets& nets,
                   const Context& context) {
  if (!choice.borders && std::ranges::none_of(wishes, &TabWish::second)) {
    return;
  }
  const std::size_t first = nets.tabs.size();
  MoreTabs more(surface, panels, options.tabs, wishes, nets, context);
  more.add_seconds();
  if (choice.borders) {
    more.add_borders(choice, context);
  }
  if (options.sheet && nets.tabs.size() > first) {
    drop_beyond(*options.sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
