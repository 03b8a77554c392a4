// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/place_tabs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/elementary.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

namespace {

/// Areas that differ by less than this share are equal: rounding of a symmetric model.
constexpr double same_area = 1e-6;

bool clearly_less(double a, double b) {
  return a < b * (1.0 - same_area);
}

/// Which side of each join should give the tab: the smaller flat region; where they are equal, the piece that
/// gives more of the seam already, so that the other piece has a clean edge there.
std::vector<std::uint8_t> preferred_sides(const std::vector<TabSite>& sites) {
  using Seam = std::pair<PieceId, PieceId>;
  const auto seam_of = [&](std::size_t join) {
    return Seam(std::minmax(sites[2 * join].piece, sites[2 * join + 1].piece));
  };
  std::map<Seam, double> gives_more;  // length given by the first piece minus that given by the second
  std::vector<std::uint8_t> preferred(sites.size() / 2, 0);
  for (std::size_t join = 0; join < preferred.size(); ++join) {
    const TabSite& a = sites[2 * join];
    const TabSite& b = sites[2 * join + 1];
    preferred[join] = clearly_less(b.area, a.area) ? 1 : 0;
    if (clearly_less(a.area, b.area) || clearly_less(b.area, a.area)) {
      const PieceId giver = preferred[join] == 0 ? a.piece : b.piece;
      gives_more[seam_of(join)] += giver == seam_of(join).first ? a.length : -a.length;
    }
  }
  for (std::size_t join = 0; join < preferred.size(); ++join) {
    const TabSite& a = sites[2 * join];
    const TabSite& b = sites[2 * join + 1];
    if (!clearly_less(a.area, b.area) && !clearly_less(b.area, a.area) && a.piece != b.piece) {
      const PieceId giver = gives_more[seam_of(join)] >= 0.0 ? seam_of(join).first : seam_of(join).second;
      preferred[join] = a.piece == giver ? 0 : 1;
    }
  }
  return preferred;
}

/// How far the walls around a room reach, mm: farther than any tab.
constexpr double wall_mm = 1000.0;

/// What lies outside a room is in the way of a site's tab.
void add_walls(const TabRoom& room, const TabOptions& options, TabSite& site) {
  const ConvexShape widest = widest_tab(site.length, options);
  if (widest.empty()) {
    return;
  }
  const Vec2 x{elementary::cos(room.angle), -elementary::sin(room.angle)};
  const Vec2 y = perpendicular(x);
  // Tabs keep the clearance from the walls, and may touch the room's border.
  const Vec2 low = room.box.low - Vec2{options.clearance_mm, options.clearance_mm};
  const Vec2 high = room.box.high + Vec2{options.clearance_mm, options.clearance_mm};
  const auto add = [&](Vec2 from, Vec2 to) {
    ConvexShape wall;
    for (const Vec2 p : {from, Vec2{to.x, from.y}, to, Vec2{from.x, to.y}}) {
      wall.push_back(p.x * x + p.y * y);
    }
    const Obstacle obstacle{site.own.in(wall), Obstacle::Kind::thing};
    if (!clear_of(widest, obstacle, options.clearance_mm)) {
      site.obstacles.push_back(obstacle);
    }
  };
  const Vec2 far{wall_mm, wall_mm};
  add(low - far, {low.x, high.y + wall_mm});
  add({high.x, low.y - wall_mm}, high + far);
  add(low - far, {high.x + wall_mm, low.y});
  add({low.x - wall_mm, high.y}, high + far);
}

/// Why neither side of a join has room.
NoTab reason_for_none(const TabSite& a, const TabSite& b, const TabOptions& options, bool time_up) {
  if (!long_enough(a.length, options)) {
    return NoTab::edge_too_short;
  }
  if (time_up) {
    return NoTab::time_up;
  }
  if (!a.has_paper && !b.has_paper) {
    return NoTab::too_little_paper;
  }
  for (const TabSite* site : {&a, &b}) {
    if (!low_tab_shape(site->length, target_outline(*site), options).outline.empty()) {
      return NoTab::no_room;
    }
  }
  return NoTab::target_too_small;
}

/// No tabs: there is no time to find places for them.
void give_up(Nets& nets) {
  for (Join& join : nets.joins) {
    join.no_tab = NoTab::time_up;
  }
}

/// Could neither side of a join have a usable tab, whatever the net?
bool both_too_narrow(const TabSite& a, const TabSite& b, const TabOptions& options) {
  return !target_allows_usable(a, options) && !target_allows_usable(b, options);
}

}  // namespace

void place_tabs(const TabProblem& problem, Nets& nets, const Context& context) {
  const TabOptions& options = problem.options;
  nets.tabs = {};
  for (Join& join : nets.joins) {
    join.tab = TabId();
    join.no_tab = NoTab::not_wanted;
    join.too_narrow = false;
  }
  if (!options.wanted) {
    return;
  }
  if (context.out_of_grace()) {
    give_up(nets);
    return;
  }
  const TabOptions highest = with_greatest_height(options, problem.requests);
  std::vector<TabSite> sites = find_tab_sites(problem.surface, problem.panels, nets, highest, context);
  if (context.out_of_grace()) {
    give_up(nets);
    return;
  }
  for (TabSite& site : sites) {
    if (site.piece.value() < problem.rooms.size() && problem.rooms[site.piece.value()]) {
      add_walls(*problem.rooms[site.piece.value()], highest, site);
    }
  }
  const auto chosen = assign_tabs(sites, preferred_sides(sites), options, context, problem.requests);
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    Join& join = nets.joins[j];
    const auto& tab = chosen[j.value()];
    const bool time_up = context.out_of_grace();
    join.too_narrow = !(tab && tab->shape.usable) && !time_up &&
                      both_too_narrow(sites[2 * j.value()], sites[2 * j.value() + 1], options);
    if (!tab && !problem.requests.empty() && !problem.requests[j.value()].wanted) {
      continue;  // NoTab::not_wanted
    }
    if (!tab) {
      join.no_tab = reason_for_none(sites[2 * j.value()], sites[2 * j.value() + 1], options, time_up);
      continue;
    }
    const TabSite& site = sites[tab->site];
    const ConvexShape placed = site.own.out(tab->shape.outline);
    join.tab = nets.tabs.push_back({site.side, j, std::vector<Vec2>(placed.begin(), placed.end())});
    join.no_tab = NoTab::has_tab;
  }
}

bool is_usable(const mesh::Surface& surface, const Nets& nets, TabId tab, const TabOptions& options) {
  if (nets.tabs[tab].slit) {
    return true;
  }
  const CornerId side = nets.tabs[tab].side;
  const std::vector<Vec2>& polygon = nets.tabs[tab].polygon;
  return is_usable(tab_frame(nets, side).in(ConvexShape(std::span<const Vec2>(polygon))),
                   surface.length(surface.edge(side)), options);
}

std::size_t tabs_usable(const mesh::Surface& surface, const Nets& nets, const TabOptions& options) {
  return static_cast<std::size_t>(std::count_if(nets.joins.begin(), nets.joins.end(), [&](const Join& join) {
    return join.tab.valid() && is_usable(surface, nets, join.tab, options);
  }));
}

}  // namespace ridgecraft::unfold
