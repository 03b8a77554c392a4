// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {
namespace {

// Where the sheet is laid over pieces that are nearly as large, so that few joins lose their tabs.

/// Outside by less than this is inside, mm: rounding.
constexpr double inside_mm = 1e-6;
/// Choosing the rooms of all pieces again, each with the others known.
constexpr int passes = 3;
/// Sides of a hull along which a sheet is laid, longest first.
constexpr std::size_t most_turns = 48;
/// What a room costs: for each join that no tab can be on, each tab that must go to the other side, each
/// that becomes lower, and each that could have stood there.
constexpr double no_tab_cost = 100.0;
constexpr double moved_cost = 1.0;
constexpr double lower_cost = 0.3;
constexpr double closed_cost = 0.05;

Vec2 in_turned(Vec2 right, Vec2 p) {
  return {dot(p, right), cross(right, p)};
}

/// By how much a point lies outside, mm; negative inside.
double beyond(const TabRoom& room, Vec2 p) {
  const Vec2 q = in_turned({elementary::cos(room.angle), -elementary::sin(room.angle)}, p);
  return std::max({room.box.low.x - q.x, q.x - room.box.high.x, room.box.low.y - q.y, q.y - room.box.high.y});
}

Box2 box_in(Vec2 right, const std::vector<Vec2>& points) {
  Box2 box;
  for (const Vec2 p : points) {
    box.add(in_turned(right, p));
  }
  return box;
}

/// The lowest tab that holds, as steep as tabs may be.
ConvexShape least_tab(double length, const TabOptions& options) {
  const double height = std::min({usable_height_mm, options.height_mm, length});
  const double cotangent = std::min(1.0 / elementary::tan(options.steepest_angle), 0.4 * length / height);
  return trapezoid(0.0, length, height, cotangent, cotangent);
}

class Chooser {
 public:
  Chooser(const Sheet& sheet, const TabOptions& options, const std::vector<TabSite>& sites, const Nets& nets,
          std::span<std::optional<TabRoom>> rooms)
      : sheet_(sheet), sites_(sites), nets_(nets), rooms_(rooms), sites_of_(nets.pieces.size()) {
    tab_on_.assign(sites.size(), nullptr);
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
      sites_of_[sites[s].piece].push_back(s);
      const ConvexShape least = least_tab(sites[s].length, options);
      least_.push_back(sites[s].own.out(least));
      const TabId tab = nets.joins[JoinId(s / 2)].tab;
      if (tab.valid() && nets.tabs[tab].side == sites[s].side) {
        tab_on_[s] = &nets.tabs[tab].polygon;
      }
    }
    closed_.assign(sites.size(), false);
  }

  bool run() {
    bool added = false;
    std::vector<PieceId> large;
    for (const PieceId p : ids<PieceId>(nets_.pieces.size())) {
      const std::vector<Vec2> faces = hull_without_tabs(p);
      if (!rooms_[p.value()] && !angle_to_fit(hull_with_tabs(p, faces), sheet_) &&
          angle_to_fit(faces, sheet_)) {
        added = true;
        rooms_[p.value()] = TabRoom{};
        large.push_back(p);
      } else if (rooms_[p.value()]) {
        large.push_back(p);
        close(p, *rooms_[p.value()]);
      }
    }
    for (int pass = 0; added && pass < passes; ++pass) {
      for (const PieceId p : large) {
        rooms_[p.value()] = best(p);
        close(p, *rooms_[p.value()]);
      }
    }
    return added;
  }

 private:
  [[nodiscard]] std::vector<Vec2> hull_without_tabs(PieceId p) const {
    std::vector<Vec2> points;
    for (const FaceId f : nets_.pieces[p].faces) {
      points.insert(points.end(), nets_.flat[f].begin(), nets_.flat[f].end());
    }
    return convex_hull(std::move(points));
  }

  [[nodiscard]] std::vector<Vec2> hull_with_tabs(PieceId p, std::vector<Vec2> points) const {
    for (const std::uint32_t s : sites_of_[p]) {
      if (tab_on_[s] != nullptr) {
        points.insert(points.end(), tab_on_[s]->begin(), tab_on_[s]->end());
      }
    }
    return convex_hull(std::move(points));
  }

  static bool outside(const TabRoom& room, std::span<const Vec2> shape) {
    return std::any_of(shape.begin(), shape.end(), [&](Vec2 p) { return beyond(room, p) > inside_mm; });
  }
  [[nodiscard]] bool closes(const TabRoom& room, std::uint32_t s) const {
    return outside(room, {least_[s].begin(), least_[s].end()});
  }

  void close(PieceId p, const TabRoom& room) {
    for (const std::uint32_t s : sites_of_[p]) {
      closed_[s] = closes(room, s);
    }
  }

  [[nodiscard]] double cost(PieceId p, const TabRoom& room) const {
    double sum = 0.0;
    for (const std::uint32_t s : sites_of_[p]) {
      const std::uint32_t other = s ^ 1U;
      if (closes(room, s)) {
        const bool other_closed = sites_[other].piece == p ? closes(room, other) : bool{closed_[other]};
        sum += other_closed ? no_tab_cost : tab_on_[s] != nullptr ? moved_cost : closed_cost;
      } else if (tab_on_[s] != nullptr && outside(room, *tab_on_[s])) {
        sum += lower_cost;
      }
    }
    return sum;
  }

  /// The directions in which the sheet may lie.
  [[nodiscard]] std::vector<Vec2> turns(const std::vector<Vec2>& hull) const {
    std::vector<Vec2> sides;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      sides.push_back(hull[(i + 1) % hull.size()] - hull[i]);
    }
    std::stable_sort(sides.begin(), sides.end(), [](Vec2 a, Vec2 b) { return length(a) > length(b); });
    sides.resize(std::min(sides.size(), most_turns));
    std::vector<Vec2> found;
    for (const Vec2 side : sides) {
      const Vec2 right = side / length(side);
      found.push_back(right);
      found.push_back(perpendicular(right));
    }
    if (const auto angle = angle_to_fit(hull, sheet_)) {
      // The piece turned by it lies along the sheet's sides.
      found.push_back({elementary::cos(*angle), -elementary::sin(*angle)});
    }
    return found;
  }

  [[nodiscard]] TabRoom best(PieceId p) const {
    const std::vector<Vec2> hull = hull_without_tabs(p);
    const std::vector<Vec2> all = hull_with_tabs(p, hull);
    TabRoom found;
    double least = INFINITY;
    for (const Vec2 right : turns(hull)) {
      const Box2 faces = box_in(right, hull);
      if (faces.size().x > sheet_.width + inside_mm || faces.size().y > sheet_.height + inside_mm) {
        continue;
      }
      const Box2 tabs = box_in(right, all);
      for (const double x : starts(faces.low.x, faces.high.x, tabs.low.x, tabs.high.x, sheet_.width)) {
        for (const double y : starts(faces.low.y, faces.high.y, tabs.low.y, tabs.high.y, sheet_.height)) {
          const TabRoom room{elementary::atan2(-right.y, right.x),
                             {{x, y}, {x + sheet_.width, y + sheet_.height}}};
          const double here = cost(p, room);
          if (here < least - 1e-9) {
            least = here;
            found = room;
          }
        }
      }
    }
    return found;
  }

  /// Where an interval of the sheet's size may begin around the faces: in the middle, with all tabs of one
  /// end inside, or with as much as possible on one side.
  static std::vector<double> starts(double low, double high, double low_tabs, double high_tabs, double size) {
    const double first = std::min(high - size, low);
    const double last = low;
    std::vector<double> found{0.5 * (first + last)};
    for (const double start : {low_tabs, high_tabs - size, first, last}) {
      const double clamped = std::clamp(start, first, last);
      if (std::find(found.begin(), found.end(), clamped) == found.end()) {
        found.push_back(clamped);
      }
    }
    return found;
  }

  const Sheet& sheet_;
  const std::vector<TabSite>& sites_;
  const Nets& nets_;
  std::span<std::optional<TabRoom>> rooms_;
  IdVector<PieceId, std::vector<std::uint32_t>> sites_of_;
  std::vector<const std::vector<Vec2>*> tab_on_;  ///< the tab on each site
  std::vector<ConvexShape> least_;                ///< of each site
  std::vector<bool> closed_;                      ///< sites that a room leaves no tab
};

/// Gives each piece that doesn't fit the sheet with its tabs, but does without, a room, and chooses all rooms
/// so that few tabs lie outside, least of all such as have no paper on the other side of their join. `rooms`
/// has a place for each piece. False when no piece needed one. O(passes * rooms * turns * tabs).
bool add_rooms(const Sheet& sheet, const TabOptions& options, const std::vector<TabSite>& sites,
               const Nets& nets, std::span<std::optional<TabRoom>> rooms) {
  return Chooser(sheet, options, sites, nets, rooms).run();
}

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

void fit_tabs_to_sheet(const TabProblem& problem, const Sheet& sheet, Nets& nets, const Context& context) {
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
  const std::vector<TabSite> sites =
      find_tab_sites(problem.surface, problem.panels, nets, problem.options, context);
  for (int round = 0; round < most_rounds && !context.out_of_grace() &&
                      add_rooms(sheet, problem.options, sites, nets, rooms);
       ++round) {
    place_tabs({problem.surface, problem.panels, problem.options, problem.requests, rooms}, nets, context);
  }
  for (const JoinId j : had) {
    if (!nets.joins[j].tab.valid()) {
      nets.joins[j].no_tab = NoTab::beyond_sheet;
    }
  }
  drop_tabs_beyond_sheet(sheet, nets);
}

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
