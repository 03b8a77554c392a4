// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_fit.hpp"

#include <algorithm>
#include <vector>

#include "mesh/surface.hpp"
#include "unfold/sheet.hpp"

namespace ridgecraft::unfold {
namespace {

double area(const std::vector<Vec2>& polygon) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * doubled;
}

/// Keeps the tabs marked so, with new numbers.
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
      join.no_tab = join.tab.valid() ? NoTab::has_tab : NoTab::no_room;
    }
  }
}

}  // namespace

void drop_tabs_beyond_sheet(const Sheet& sheet, Nets& nets) {
  IdVector<PieceId, std::vector<TabId>> tabs(nets.pieces.size());
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    tabs[nets.piece[mesh::face_of(nets.tabs[t].side)]].push_back(t);
  }
  IdVector<TabId, std::uint8_t> keep(nets.tabs.size(), 1);
  bool dropped = false;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    std::vector<TabId>& here = tabs[p];
    std::stable_sort(here.begin(), here.end(), [&](TabId a, TabId b) {
      return area(nets.tabs[a].polygon) < area(nets.tabs[b].polygon);
    });
    while (!here.empty()) {
      std::vector<Vec2> points;
      for (const FaceId f : nets.pieces[p].faces) {
        points.insert(points.end(), nets.flat[f].begin(), nets.flat[f].end());
      }
      for (const TabId t : here) {
        points.insert(points.end(), nets.tabs[t].polygon.begin(), nets.tabs[t].polygon.end());
      }
      if (angle_to_fit(convex_hull(std::move(points)), sheet)) {
        break;
      }
      keep[here.back()] = 0;
      here.pop_back();
      dropped = true;
    }
  }
  if (dropped) {
    keep_only(keep, nets);
  }
}

}  // namespace ridgecraft::unfold
