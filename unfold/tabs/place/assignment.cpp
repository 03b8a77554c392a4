// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/boxes.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"

namespace ridgecraft::unfold {

namespace {

/// A base that begins nearer to a corner of the edge than this covers the corner, mm.
constexpr double covers_corner_mm = 1e-6;
/// Tabs behind one face that overlap by more than this lie on each other, mm: a paper's thickness.
constexpr double stacked_mm = 0.2;

/// What a tab costs on a side that wasn't asked for: more than one that is hard to make, less than one that
/// hardly holds.
constexpr double side_not_asked = 200.0;

/// Tabs that one may push to other places.
constexpr std::size_t most_moved = 2;
/// Cheaper by less than this isn't worth a change: rounding.
constexpr double least_gain = 1e-9;

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
             const TabOptions& options, std::span<const TabRequest> requests)
      : sites_(sites),
        preferred_(preferred),
        options_(options),
        requests_(requests),
        chosen_(sites.size() / 2) {
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
      const TabSite& site = sites[s];
      const TabOptions& own = options_of(s);
      widest_.push_back(widest_tab(site.length, own));
      largest_.push_back(
          widest_.back().empty() || !allowed(s)
              ? ConvexShape()
              : largest_tab({0.0, site.length, site.length}, site.obstacles, own, TabNeed::usable));
      shapes_.push_back(tab_shapes(largest_.back(), site.length, own));
      if (shapes_.back().empty() && allowed(s) && target_allows_usable(site, own)) {
        shapes_.back() = partial_tab_shapes(site.length, site.obstacles, own);
      }
    }
    collisions_ = find_neighbors(
        sites, [&](std::uint32_t s) { return sites[s].piece.value(); },
        [&](std::uint32_t s) { return sites[s].own.out(widest_[s]); },
        [&](std::uint32_t a, std::uint32_t b) {
          // Without leave at a common corner, which a tab on a part of the edge hasn't.
          return !apart(sites[a].own.out(widest_[a]), sites[b].own.out(widest_[b]), options.clearance_mm);
        },
        options.clearance_mm);
    stacks_ = find_neighbors(
        sites, [&](std::uint32_t s) { return sites[s].target_piece.value(); },
        [&](std::uint32_t s) { return sites[s].target.out(widest_[s]); },
        [&](std::uint32_t a, std::uint32_t b) {
          return sites[a].target_region == sites[b].target_region && stacked(a, widest_[a], b, widest_[b]);
        },
        0.0);
  }

  std::vector<std::optional<ChosenTab>> solve(const Context& context) {
    const std::vector<std::uint32_t> order = most_constrained_first();
    for (const std::uint32_t join : order) {
      static_cast<void>(goes_on(context));
      chosen_[join] = best_free(join);
    }
    for (int pass = 0; pass < 3; ++pass) {
      bool changed = false;
      for (const std::uint32_t join : order) {
        changed = (goes_on(context) && !chosen_[join] && exchange(join)) || changed;
      }
      for (const std::uint32_t join : order) {
        changed = (goes_on(context) && improve(join)) || changed;
      }
      if (!changed) {
        break;
      }
    }
    for (const std::uint32_t join : order) {
      if (!chosen_[join] && goes_on(context)) {
        chosen_[join] = best_low(join);
      }
    }
    return std::move(chosen_);
  }

 private:
  /// Whether there is time for more than each join's first choice.
  bool goes_on(const Context& context) {
    if (++steps_ % 256 == 0) {
      context.check();
      time_up_ = context.out_of_grace();
    }
    return !time_up_;
  }

  [[nodiscard]] const TabOptions& options_of(std::uint32_t site) const {
    return requests_.empty() ? options_ : requests_[site / 2].options;
  }
  /// Whether a tab may grow there at all.
  [[nodiscard]] bool allowed(std::uint32_t site) const {
    if (requests_.empty()) {
      return true;
    }
    const TabRequest& request = requests_[site / 2];
    return request.wanted && !(request.no_other_side && request.side && *request.side != site % 2);
  }

  /// Cost of using the site instead of the preferred one.
  [[nodiscard]] double side_cost(std::uint32_t site) const {
    if (!requests_.empty() && requests_[site / 2].side) {
      return *requests_[site / 2].side == site % 2 ? 0.0 : side_not_asked;
    }
    return preferred_[site / 2] == site % 2 ? 0.0 : tab_costs.other_side;
  }

  [[nodiscard]] bool stacked(std::uint32_t a, const ConvexShape& tab_a, std::uint32_t b,
                             const ConvexShape& tab_b) const {
    return separation(sites_[a].target.out(tab_a), sites_[b].target.out(tab_b)) < -stacked_mm;
  }

  [[nodiscard]] const ConvexShape* chosen_on(std::uint32_t site) const {
    const std::optional<ChosenTab>& chosen = chosen_[site / 2];
    return chosen && chosen->site == site ? &chosen->shape.outline : nullptr;
  }

  /// Joins whose chosen tab collides with this one, at most one more than may be moved.
  [[nodiscard]] std::vector<std::uint32_t> collisions(std::uint32_t site, const ConvexShape& tab) const {
    std::vector<std::uint32_t> joins;
    for (const std::uint32_t other : collisions_[site]) {
      const ConvexShape* there = chosen_on(other);
      if (there != nullptr && !tabs_clear(sites_[site], tab, sites_[other], *there, options_.clearance_mm)) {
        joins.push_back(other / 2);
        if (joins.size() > most_moved) {
          break;
        }
      }
    }
    return joins;
  }

  [[nodiscard]] double stacking_cost(std::uint32_t site, const ConvexShape& tab) const {
    double cost = 0.0;
    for (const std::uint32_t other : stacks_[site]) {
      const ConvexShape* there = chosen_on(other);
      cost += there != nullptr && stacked(site, tab, other, *there) ? tab_costs.stacked : 0.0;
    }
    return cost;
  }

  /// The cheapest usable tab of a join that collides with none and costs less than `limit`; if there is none
  /// and it may be cut back, one that fits among the others.
  [[nodiscard]] std::optional<ChosenTab> best_free(std::uint32_t join, double limit = INFINITY,
                                                   bool cut_back = true) const {
    std::optional<ChosenTab> best;
    const auto offer = [&](std::uint32_t site, const TabShape& shape, double extra) {
      const double cost = shape.cost + side_cost(site) + extra;
      if (cost >= limit) {
        return;
      }
      const double total = cost + stacking_cost(site, shape.outline);
      if (total < limit && collisions(site, shape.outline).empty()) {
        limit = total;
        best = ChosenTab{site, {shape.outline, shape.usable, total}};
      }
    };
    for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
      for (const TabShape& shape : shapes_[site]) {
        offer(site, shape, 0.0);
      }
    }
    if (!best && cut_back) {
      for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
        if (!shapes_[site].empty() && tab_costs.trimmed + side_cost(site) < limit) {
          for (const TabShape& shape : shapes_among_tabs(site)) {
            offer(site, shape, tab_costs.trimmed);
          }
        }
      }
    }
    return best;
  }

  /// The obstacles of a site and the tabs chosen so far that it might collide with; none of these: nothing.
  [[nodiscard]] std::vector<Obstacle> obstacles_and_tabs(std::uint32_t site) const {
    std::vector<Obstacle> obstacles;
    for (const std::uint32_t other : collisions_[site]) {
      if (const ConvexShape* there = chosen_on(other)) {
        if (obstacles.empty()) {
          obstacles = sites_[site].obstacles;
        }
        obstacles.push_back(tab_as_obstacle(sites_[site], sites_[other], *there));
      }
    }
    return obstacles;
  }

  /// Usable shapes that are cut back for the tabs chosen so far.
  [[nodiscard]] std::vector<TabShape> shapes_among_tabs(std::uint32_t site) const {
    const std::vector<Obstacle> obstacles = obstacles_and_tabs(site);
    if (obstacles.empty()) {
      return {};
    }
    ConvexShape largest = largest_[site];
    for (std::size_t i = sites_[site].obstacles.size(); i < obstacles.size() && !largest.empty(); ++i) {
      largest = trimmed(largest, obstacles[i], options_.clearance_mm);
    }
    std::vector<TabShape> shapes = tab_shapes(largest, sites_[site].length, options_of(site));
    if (shapes.empty()) {
      shapes = partial_tab_shapes(sites_[site].length, obstacles, options_of(site));
    }
    return shapes;
  }

  /// The better tab of those that are less than usable.
  [[nodiscard]] std::optional<ChosenTab> best_low(std::uint32_t join) const {
    std::optional<ChosenTab> best;
    for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
      if (!allowed(site)) {
        continue;
      }
      std::vector<Obstacle> obstacles = obstacles_and_tabs(site);
      if (obstacles.empty()) {
        obstacles = sites_[site].obstacles;
      }
      TabShape shape = low_tab_shape(sites_[site].length, obstacles, options_of(site));
      shape.cost += side_cost(site);
      if (!shape.outline.empty() && (!best || shape.cost < best->shape.cost) &&
          collisions(site, shape.outline).empty()) {
        best = ChosenTab{site, shape};
      }
    }
    return best;
  }

  /// Gives a join a place by moving one other tab, or two.
  bool exchange(std::uint32_t join) {
    for (const std::uint32_t site : {2 * join, 2 * join + 1}) {
      for (const TabShape& shape : shapes_[site]) {
        const std::vector<std::uint32_t> in_the_way = collisions(site, shape.outline);
        if (in_the_way.size() > most_moved) {
          continue;
        }
        std::vector<std::optional<ChosenTab>> old;
        for (const std::uint32_t other : in_the_way) {
          old.push_back(std::exchange(chosen_[other], std::nullopt));
        }
        chosen_[join] = ChosenTab{site, {shape.outline, true, shape.cost + side_cost(site)}};
        const bool all_moved = std::all_of(in_the_way.begin(), in_the_way.end(), [this](std::uint32_t other) {
          chosen_[other] = best_free(other);
          return chosen_[other].has_value();
        });
        if (all_moved) {
          return true;
        }
        chosen_[join].reset();
        for (std::size_t i = 0; i < old.size(); ++i) {
          chosen_[in_the_way[i]] = old[i];
        }
      }
    }
    return false;
  }

  /// Looks for a cheaper tab with all others as they are.
  bool improve(std::uint32_t join) {
    if (!chosen_[join] || chosen_[join]->shape.cost <= 0.0) {
      return false;
    }
    const ChosenTab old = *chosen_[join];
    chosen_[join].reset();
    const std::optional<ChosenTab> better = best_free(join, old.shape.cost - least_gain, false);
    chosen_[join] = better ? better : old;
    return better.has_value();
  }

  [[nodiscard]] std::vector<std::uint32_t> most_constrained_first() const {
    struct Key {
      std::size_t sides = 0;
      std::size_t shapes = 0;
      double length = 0.0;
    };
    std::vector<Key> keys(chosen_.size());
    for (std::uint32_t s = 0; s < sites_.size(); ++s) {
      Key& key = keys[s / 2];
      key.sides += shapes_[s].empty() ? 0U : 1U;
      key.shapes += shapes_[s].size();
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
  std::span<const TabRequest> requests_;       // of each join, or none
  std::vector<ConvexShape> widest_;            // of each site: no tab leaves it
  std::vector<ConvexShape> largest_;           // of each site, among faces and inside its target
  std::vector<std::vector<TabShape>> shapes_;  // of each site, best first
  Neighbors collisions_;                       // sites whose tabs may collide
  Neighbors stacks_;                           // sites whose tabs may lie on each other behind one face
  std::vector<std::optional<ChosenTab>> chosen_;
  std::uint32_t steps_ = 0;
  bool time_up_ = false;
};

}  // namespace

bool tabs_clear(const TabSite& a, const ConvexShape& tab_a, const TabSite& b, const ConvexShape& tab_b,
                double clearance_mm) {
  return keeps_clear(
      share_corner(a, tab_a, b, tab_b), clearance_mm,
      [&](double least) { return apart(a.own.out(tab_a), b.own.out(tab_b), least); },
      [&](double least) {
        const ConvexShape upper_a = a.own.out(above_corner_zone(tab_a));
        const ConvexShape upper_b = b.own.out(above_corner_zone(tab_b));
        return upper_a.empty() || upper_b.empty() || apart(upper_a, upper_b, least);
      });
}

Obstacle tab_as_obstacle(const TabSite& here, const TabSite& other, const ConvexShape& tab) {
  const bool left = covers(other, tab, here.ends[0]);
  const bool right = covers(other, tab, here.ends[1]);
  Obstacle obstacle{here.own.in(other.own.out(tab)), Obstacle::Kind::thing};
  obstacle.kind = left && right ? Obstacle::Kind::at_both
                  : left        ? Obstacle::Kind::at_base_left
                  : right       ? Obstacle::Kind::at_base_right
                                : Obstacle::Kind::thing;
  return obstacle;
}

std::vector<std::optional<ChosenTab>> assign_tabs(const std::vector<TabSite>& sites,
                                                  const std::vector<std::uint8_t>& preferred,
                                                  const TabOptions& options, const Context& context,
                                                  std::span<const TabRequest> requests) {
  return Assignment(sites, preferred, options, requests).solve(context);
}

}  // namespace ridgecraft::unfold
