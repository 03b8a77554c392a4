// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/fit.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sheet_over_piece.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {
namespace {

double area(const std::vector<Vec2>& polygon) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * doubled;
}

/// Rounds of placing tabs: a tab that moves to another piece may be too much for that one.
constexpr int most_rounds = 8;

/// Takes tabs away, largest first, from each piece that fits the sheet without them but not with them.
void drop_tabs_beyond_sheet(const Sheet& sheet, Nets& nets) {
  TabsOfPiece tabs = tabs_of_pieces(nets);
  IdVector<TabId, std::uint8_t> keep(nets.tabs.size(), 1);
  bool dropped = false;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    std::vector<TabId>& here = tabs[p];
    std::stable_sort(here.begin(), here.end(), [&](TabId a, TabId b) {
      return area(nets.tabs[a].polygon) < area(nets.tabs[b].polygon);
    });
    while (!here.empty() && !fits_with(nets, p, here, sheet)) {
      keep[here.back()] = 0;
      here.pop_back();
      dropped = true;
    }
  }
  if (dropped) {
    keep_only(keep, nets);
  }
}

}  // namespace

TabsOfPiece tabs_of_pieces(const Nets& nets) {
  TabsOfPiece tabs(nets.pieces.size());
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    tabs[nets.piece[mesh::face_of(nets.tabs[t].side)]].push_back(t);
  }
  return tabs;
}

bool fits_with(const Nets& nets, PieceId piece, std::span<const TabId> tabs, const Sheet& sheet) {
  std::vector<Vec2> points;
  for (const FaceId f : nets.pieces[piece].faces) {
    points.insert(points.end(), nets.flat[f].begin(), nets.flat[f].end());
  }
  for (const TabId t : tabs) {
    points.insert(points.end(), nets.tabs[t].polygon.begin(), nets.tabs[t].polygon.end());
  }
  return angle_to_fit(convex_hull(points), sheet).has_value();
}

void keep_only(const IdVector<TabId, std::uint8_t>& keep, Nets& nets) {
  IdVector<TabId, TabId> number(nets.tabs.size());
  IdVector<TabId, Tab> kept;
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    if (keep[t] != 0) {
      number[t] = kept.push_back(std::move(nets.tabs[t]));
    }
  }
  nets.tabs = std::move(kept);
  for (Join& join : nets.joins) {
    if (join.tab.valid()) {
      join.tab = number[join.tab];
      join.no_tab = join.tab.valid() ? NoTab::has_tab : NoTab::beyond_sheet;
    }
  }
}

void fit_tabs_to_sheet(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options,
                       const Sheet& sheet, Nets& nets, const Context& context,
                       std::span<const TabWish> wishes) {
  const TabsOfPiece tabs = tabs_of_pieces(nets);
  const auto fits = [&](PieceId p) { return fits_with(nets, p, tabs[p], sheet); };
  const auto pieces = ids<PieceId>(nets.pieces.size());
  if (std::all_of(pieces.begin(), pieces.end(), fits)) {
    return;
  }
  std::vector<std::optional<TabRoom>> rooms(nets.pieces.size());
  std::vector<JoinId> had;
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    if (nets.joins[j].tab.valid()) {
      had.push_back(j);
    }
  }
  const std::vector<TabSite> sites = find_tab_sites(surface, panels, nets, options, context);
  for (int round = 0;
       round < most_rounds && !context.out_of_grace() && add_rooms(sheet, options, sites, nets, rooms);
       ++round) {
    place_tabs(surface, panels, options, nets, context, rooms, wishes);
  }
  for (const JoinId j : had) {
    if (!nets.joins[j].tab.valid()) {
      nets.joins[j].no_tab = NoTab::beyond_sheet;
    }
  }
  drop_tabs_beyond_sheet(sheet, nets);
}

}  // namespace ridgecraft::unfold
