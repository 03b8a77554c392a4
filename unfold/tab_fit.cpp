// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mesh/surface.hpp"
#include "unfold/sheet.hpp"
#include "unfold/tabs.hpp"

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

/// Slack of the fit, mm, as angle_to_fit has it.
constexpr double fit_slack = 1e-7;
/// Rounds of placing tabs: a tab that moves to another piece may be too much for that one.
constexpr int most_rounds = 3;

using TabsOfPiece = IdVector<PieceId, std::vector<TabId>>;

TabsOfPiece tabs_of_pieces(const Nets& nets) {
  TabsOfPiece tabs(nets.pieces.size());
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    tabs[nets.piece[mesh::face_of(nets.tabs[t].side)]].push_back(t);
  }
  return tabs;
}

std::vector<Vec2> outline_points(const Nets& nets, PieceId piece, const std::vector<TabId>& tabs) {
  std::vector<Vec2> points;
  for (const FaceId f : nets.pieces[piece].faces) {
    points.insert(points.end(), nets.flat[f].begin(), nets.flat[f].end());
  }
  for (const TabId t : tabs) {
    points.insert(points.end(), nets.tabs[t].polygon.begin(), nets.tabs[t].polygon.end());
  }
  return points;
}

Box2 turned_box(const std::vector<Vec2>& points, double angle) {
  const Vec2 x{std::cos(angle), -std::sin(angle)};
  Box2 box;
  for (const Vec2 p : points) {
    box.add({dot(x, p), dot(perpendicular(x), p)});
  }
  return box;
}

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Where a window of this size that holds `whole` holds most of the others; none where it can't hold it.
std::optional<Interval> best_window(const Interval& whole, double size, const std::vector<Interval>& others) {
  const double first = whole.high - size;
  if (first > whole.low + fit_slack) {
    return {};
  }
  std::vector<double> starts{std::fmin(first, whole.low), whole.low};
  for (const Interval& other : others) {
    for (const double start : {other.low, other.high - size}) {
      if (start > first && start < whole.low) {
        starts.push_back(start);
      }
    }
  }
  std::optional<Interval> best;
  std::ptrdiff_t most = -1;
  for (const double start : starts) {
    const auto held = std::count_if(others.begin(), others.end(), [&](const Interval& other) {
      return other.low >= start - fit_slack && other.high <= start + size + fit_slack;
    });
    if (held > most) {
      most = held;
      best = Interval{start, start + size};
    }
  }
  return best;
}

/// The sheet laid over a piece so that all faces are on it, and as many tabs as possible; none where there is
/// no such place among those that are tried.
std::optional<TabRoom> best_room(const Nets& nets, PieceId piece, const std::vector<TabId>& tabs,
                                 const Sheet& sheet) {
  const std::vector<Vec2> hull = convex_hull(outline_points(nets, piece, {}));
  std::vector<double> angles;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    angles.push_back(-std::atan2(edge.y, edge.x));
    angles.push_back(angles.back() + 0.5 * std::numbers::pi);
  }
  if (const auto angle = angle_to_fit(hull, sheet)) {
    angles.push_back(*angle);
  }
  std::optional<TabRoom> best;
  std::size_t most = 0;
  for (const double angle : angles) {
    const Box2 faces = turned_box(hull, angle);
    std::vector<Box2> boxes;
    std::vector<Interval> x;
    for (const TabId t : tabs) {
      boxes.push_back(turned_box(nets.tabs[t].polygon, angle));
      x.push_back({boxes.back().low.x, boxes.back().high.x});
    }
    const auto across = best_window({faces.low.x, faces.high.x}, sheet.width, x);
    if (!across) {
      continue;
    }
    std::vector<Interval> y;
    for (const Box2& box : boxes) {
      if (box.low.x >= across->low - fit_slack && box.high.x <= across->high + fit_slack) {
        y.push_back({box.low.y, box.high.y});
      }
    }
    const auto along = best_window({faces.low.y, faces.high.y}, sheet.height, y);
    if (!along) {
      continue;
    }
    const auto held = static_cast<std::size_t>(std::count_if(y.begin(), y.end(), [&](const Interval& i) {
      return i.low >= along->low - fit_slack && i.high <= along->high + fit_slack;
    }));
    if (!best || held > most) {
      most = held;
      best = TabRoom{angle, {{across->low, along->low}, {across->high, along->high}}};
    }
  }
  return best;
}

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
    while (!here.empty() && !angle_to_fit(convex_hull(outline_points(nets, p, here)), sheet)) {
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

void fit_tabs_to_sheet(const mesh::Surface& surface, const mesh::Panels& panels, const TabOptions& options,
                       const Sheet& sheet, Nets& nets, const Context& context) {
  std::vector<std::optional<TabRoom>> rooms(nets.pieces.size());
  std::vector<JoinId> had;
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    if (nets.joins[j].tab.valid()) {
      had.push_back(j);
    }
  }
  for (int round = 0; round < most_rounds; ++round) {
    const TabsOfPiece tabs = tabs_of_pieces(nets);
    bool changed = false;
    for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
      if (!rooms[p.value()] && !angle_to_fit(convex_hull(outline_points(nets, p, tabs[p])), sheet)) {
        rooms[p.value()] = best_room(nets, p, tabs[p], sheet);
        changed = changed || rooms[p.value()].has_value();
      }
    }
    if (!changed) {
      break;
    }
    place_tabs(surface, panels, options, nets, context, rooms);
  }
  for (const JoinId j : had) {
    if (!nets.joins[j].tab.valid()) {
      nets.joins[j].no_tab = NoTab::no_room;
    }
  }
  drop_tabs_beyond_sheet(sheet, nets);
}

}  // namespace ridgecraft::unfold
