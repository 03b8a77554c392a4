// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_assignment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "unfold/box_grid.hpp"

namespace ridgecraft::unfold {

namespace {

/// A base that begins nearer to a corner of the edge than this covers the corner, mm.
constexpr double covers_corner_mm = 1e-6;
/// Tabs behind one face that overlap by more than this lie on each other, mm: a paper's thickness.
constexpr double stacked_mm = 0.2;

using Neighbors = std::vector<std::vector<std::uint32_t>>;

/// Is the corner of the edge with this net vertex also a corner of the tab's base?
bool covers(const TabSite& site, const ConvexShape& tab, std::uint32_t vertex) {
  return (site.ends[0] == vertex && tab[0].x <= covers_corner_mm) ||
         (site.ends[1] == vertex && tab[1].x >= site.length - covers_corner_mm);
}

bool share_corner(const TabSite& a, const ConvexShape& tab_a, const TabSite& b, const ConvexShape& tab_b) {
  for (const std::uint32_t end : a.ends) {
    if (covers(a, tab_a, end) && covers(b, tab_b, end)) {
      return true;
    }
  }
  return false;
}

/// Pairs of sites of different joins whose shapes, laid out by `place`, meet. `plane` tells which sites share
/// one.
template <class Plane, class Place, class Meet>
Neighbors find_neighbors(const std::vector<TabSite>& sites, Plane&& plane, Place&& place, Meet&& shapes_meet,
                         double margin) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> planes;
  for (std::uint32_t s = 0; s < sites.size(); ++s) {
    planes[plane(s)].push_back(s);
  }
  Neighbors neighbors(sites.size());
  for (const auto& [number, here] : planes) {
    std::vector<Box2> boxes;
    std::vector<std::uint32_t> filled;
    for (const std::uint32_t s : here) {
      const ConvexShape shape = place(s);
      if (!shape.empty()) {
        boxes.push_back(grown(shape.box(), margin));
        filled.push_back(s);
      }
    }
    const BoxGrid grid(boxes);
    for (std::uint32_t i = 0; i < filled.size(); ++i) {
      grid.visit(boxes[i], [&, i](std::uint32_t j) {
        if (j > i && filled[i] / 2 != filled[j] / 2 && shapes_meet(filled[i], filled[j])) {
          neighbors[filled[i]].push_back(filled[j]);
          neighbors[filled[j]].push_back(filled[i]);
        }
      });
    }
  }
  for (std::vector<std::uint32_t>& list : neighbors) {
    std::sort(list.begin(), list.end());
  }
  return neighbors;
}

class Assignment {
 public:
  Assignment(const std::vector<TabSite>& sites, const std::vector<std::uint8_t>& preferred,
             const TabOptions& options)
      : sites_(sites), preferred_(preferred), options_(options), chosen_(sites.size() / 2) {
    for (const TabSite& site : sites) {
      widest_.push_back(widest_tab(site.length, options));
      largest_.push_back(widest_.back().empty() ? ConvexShape()
                                                : largest_tab(0.0, site.length, site.obstacles, options));
      shapes_.push_back(shapes_of(site, largest_.back()));
    }
    collisions_ = find_neighbors(
        sites, [&](std::uint32_t s) { return sites[s].piece.value(); },
        [&](std::uint32_t s) { return shapes_[s].empty() ? ConvexShape() : sites[s].own.out(widest_[s]); },
        [&](std::uint32_t a, std::uint32_t b) {
          return !tabs_clear(sites[a], widest_[a], sites[b], widest_[b], options.clearance_mm);
        },
        options.clearance_mm);
    stacks_ = find_neighbors(
        sites, [&](std::uint32_t s) { return sites[s].target_piece.value(); },
        [&](std::uint32_t s) { return shapes_[s].empty() ? ConvexShape() : sites[s].target.out(widest_[s]); },
        [&](std::uint32_t a, std::uint32_t b) {
          return sites[a].target_region == sites[b].target_region && stacked(a, widest_[a], b, widest_[b]);
        },
        0.0);
  }

  std::vector<std::optional<ChosenTab>> solve(const Context& context) {
    const std::vector<std::uint32_t> order = most_constrained_first();
    for (const std::uint32_t join : order) {
      check(context);
      chosen_[join] = best_free(join, true);
    }
    for (int pass = 0; pass < 3; ++pass) {
      bool changed = false;
      for (const std::uint32_t join : order) {
        check(context);
        changed = (!chosen_[join] && exchange(join)) || changed;
      }
      for (const std::uint32_t join : order) {
        check(context);
        changed = improve(join) || changed;
      }
      if (!changed) {
        break;
      }
    }
    for (const std::uint32_t join : order) {
      if (!chosen_[join]) {
        chosen_[join] = best_free(join, false);
      }
    }
    return std::move(chosen_);
  }

 private:
  void check(const Context& context) {
    if (++steps_ % 256 == 0) {
      context.check();
    }
  }

  std::vector<TabShape> shapes_of(const TabSite& site, const ConvexShape& largest) const {
    std::vector<TabShape> shapes = tab_shapes(largest, site.length, options_);
    if (shapes.empty() || !shapes.front().usable) {
      std::vector<TabShape> partial =
          partial_tab_shapes(site.length, site.obstacles, options_, !shapes.empty());
      if (!partial.empty()) {
        return partial;
      }
    }
    return shapes;
  }

  /// Cost of using the site instead of the preferred one.
  double side_cost(std::uint32_t site) const {
    return preferred_[site / 2] == site % 2 ? 0.0 : tab_costs.other_side;
  }

  bool stacked(std::uint32_t a, const ConvexShape& tab_a, std::uint32_t b, const ConvexShape& tab_b) const {
    return separation(sites_[a].target.out(tab_a), sites_[b].target.out(tab_b)) < -stacked_mm;
  }

  const ConvexShape* chosen_on(std::uint32_t site) const {
    const std::optional<ChosenTab>& chosen = chosen_[site / 2];
    return chosen && chosen->site == site ? &chosen->shape.outline : nullptr;
  }

  /// Joins whose chosen tab collides with this one, at most two of them.
  std::vector<std::uint32_t> collisions(std::uint32_t site, const ConvexShape& tab) const {
    std::vector<std::uint32_t> joins;
    for (const std::uint32_t other : collisions_[site]) {
      const ConvexShape* there = chosen_on(other);
      if (there != nullptr && !tabs_clear(sites_[site], tab, sites_[other], *there, options_.clearance_mm)) {
        joins.push_back(other / 2);
        if (joins.size() == 2) {
          break;
        }
      }
    }
    return joins;
  }

  double stacking_cost(std::uint32_t site, const ConvexShape& tab) const {
    double cost = 0.0;
    for (const std::uint32_t other : stacks_[site]) {
      const ConvexShape* there = chosen_on(other);
      cost += there != nullptr && stacked(site, tab, other, *there) ? tab_costs.stacked : 0.0;
    }
    return cost;
  }

  /// The cheapest tab of a join that collides with none; usable ones only if asked.
  std::optional<ChosenTab> best_free(std::uint32_t join, bool usable_only) const {
    std::optional<ChosenTab> best;
    double lowest = INFINITY;
    const auto offer = [&](std::uint32_t site, const TabShape& shape, double extra) {
      const double cost = shape.cost + side_cost(site) + extra;
      if ((usable_only && !shape.usable) || cost >= lowest) {
        return;
      }
      const double total = cost + stacking_cost(site, shape.outline);
      if (total < lowest && collisions(site, shape.outline).empty()) {
        lowest = total;
        best = ChosenTab{site, {shape.outline, shape.usable, total}};
      }
    };
    for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
      for (const TabShape& shape : shapes_[site]) {
        offer(site, shape, 0.0);
      }
    }
    if (!best) {
      for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
        for (const TabShape& shape : shapes_among_tabs(site, usable_only)) {
          offer(site, shape, tab_costs.trimmed);
        }
      }
    }
    return best;
  }

  /// Shapes that are cut back for the tabs chosen so far.
  std::vector<TabShape> shapes_among_tabs(std::uint32_t site, bool usable_only) const {
    if (shapes_[site].empty() || (usable_only && !shapes_[site].front().usable)) {
      return {};
    }
    std::vector<Obstacle> obstacles = sites_[site].obstacles;
    const std::size_t faces = obstacles.size();
    for (const std::uint32_t other : collisions_[site]) {
      if (const ConvexShape* there = chosen_on(other)) {
        obstacles.push_back(as_obstacle(site, other, *there));
      }
    }
    if (obstacles.size() == faces) {
      return {};
    }
    ConvexShape largest = largest_[site];
    for (std::size_t i = faces; i < obstacles.size(); ++i) {
      largest = trimmed(largest, obstacles[i], options_.clearance_mm);
    }
    std::vector<TabShape> shapes = tab_shapes(largest, sites_[site].length, options_);
    if (shapes.empty() || !shapes.front().usable) {
      std::vector<TabShape> partial =
          partial_tab_shapes(sites_[site].length, obstacles, options_, usable_only || !shapes.empty());
      shapes.insert(shapes.end(), partial.begin(), partial.end());
    }
    return shapes;
  }

  Obstacle as_obstacle(std::uint32_t site, std::uint32_t other, const ConvexShape& tab) const {
    const TabSite& here = sites_[site];
    const bool left = covers(sites_[other], tab, here.ends[0]);
    const bool right = covers(sites_[other], tab, here.ends[1]);
    Obstacle obstacle{here.own.in(sites_[other].own.out(tab)), Obstacle::Kind::thing};
    obstacle.kind = left && right ? Obstacle::Kind::at_both
                    : left        ? Obstacle::Kind::at_base_left
                    : right       ? Obstacle::Kind::at_base_right
                                  : Obstacle::Kind::thing;
    return obstacle;
  }

  /// Gives a join a place by moving one other tab.
  bool exchange(std::uint32_t join) {
    for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
      for (const TabShape& shape : shapes_[site]) {
        if (!shape.usable) {
          continue;
        }
        const std::vector<std::uint32_t> in_the_way = collisions(site, shape.outline);
        if (in_the_way.size() != 1) {
          continue;
        }
        const std::optional<ChosenTab> old = std::exchange(chosen_[in_the_way[0]], std::nullopt);
        chosen_[join] = ChosenTab{site, {shape.outline, true, shape.cost + side_cost(site)}};
        chosen_[in_the_way[0]] = best_free(in_the_way[0], true);
        if (chosen_[in_the_way[0]]) {
          return true;
        }
        chosen_[join].reset();
        chosen_[in_the_way[0]] = old;
      }
    }
    return false;
  }

  /// Looks for a cheaper tab with all others as they are.
  bool improve(std::uint32_t join) {
    if (!chosen_[join]) {
      return false;
    }
    const ChosenTab old = *chosen_[join];
    const double before = old.shape.cost;
    chosen_[join].reset();
    std::optional<ChosenTab> better = best_free(join, true);
    const bool gain = better && better->shape.cost < before - 1e-9;
    chosen_[join] = gain ? better : old;
    return gain;
  }

  std::vector<std::uint32_t> most_constrained_first() const {
    struct Key {
      std::size_t sides = 0;
      std::size_t shapes = 0;
      double length = 0.0;
    };
    std::vector<Key> keys(chosen_.size());
    for (std::uint32_t s = 0; s < sites_.size(); ++s) {
      const bool usable = !shapes_[s].empty() && shapes_[s].front().usable;
      Key& key = keys[s / 2];
      key.sides += usable ? 1 : 0;
      key.shapes += usable ? shapes_[s].size() : 0;
      key.length = sites_[s].length;
    }
    std::vector<std::uint32_t> order(chosen_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(keys[a].sides, keys[a].shapes, -keys[a].length) <
             std::tuple(keys[b].sides, keys[b].shapes, -keys[b].length);
    });
    return order;
  }

  const std::vector<TabSite>& sites_;
  const std::vector<std::uint8_t>& preferred_;
  const TabOptions& options_;
  std::vector<ConvexShape> widest_;            // of each site: no tab leaves it
  std::vector<ConvexShape> largest_;           // of each site, among faces and inside its target
  std::vector<std::vector<TabShape>> shapes_;  // of each site, best first
  Neighbors collisions_;                       // sites whose tabs may collide
  Neighbors stacks_;                           // sites whose tabs may lie on each other behind one face
  std::vector<std::optional<ChosenTab>> chosen_;
  std::uint32_t steps_ = 0;
};

}  // namespace

bool tabs_clear(const TabSite& a, const ConvexShape& tab_a, const TabSite& b, const ConvexShape& tab_b,
                double clearance_mm) {
  const ConvexShape placed_a = a.own.out(tab_a);
  const ConvexShape placed_b = b.own.out(tab_b);
  if (!share_corner(a, tab_a, b, tab_b)) {
    return apart(placed_a, placed_b, clearance_mm);
  }
  if (!apart(placed_a, placed_b, 0.0)) {
    return false;
  }
  const HalfPlane zone{{0.0, 1.0}, corner_zone_mm};
  const ConvexShape upper_a = a.own.out(clipped(tab_a, zone));
  const ConvexShape upper_b = b.own.out(clipped(tab_b, zone));
  return upper_a.empty() || upper_b.empty() || apart(upper_a, upper_b, clearance_mm);
}

std::vector<std::optional<ChosenTab>> assign_tabs(const std::vector<TabSite>& sites,
                                                  const std::vector<std::uint8_t>& preferred,
                                                  const TabOptions& options, const Context& context) {
  return Assignment(sites, preferred, options).solve(context);
}

}  // namespace ridgecraft::unfold
