// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/weld.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/edge_order.hpp"
#include "base/same_place.hpp"
#include "mesh/repair/border_points.hpp"

namespace ridgecraft::mesh {

std::size_t join_equal_points(PolygonList& list) {
  std::vector<std::uint8_t> used(list.points.size(), 0);
  for (const std::uint32_t c : list.corners) {
    used[c] = 1;
  }
  const std::vector<std::uint32_t> stays = first_at_place(list.points, used);
  std::size_t gone = 0;
  for (std::uint32_t i = 0; i < stays.size(); ++i) {
    gone += stays[i] != i ? 1U : 0U;
  }
  if (gone > 0) {
    for (std::uint32_t& c : list.corners) {
      c = stays[c];
    }
  }
  return gone;
}

namespace {

/// Companions of a point that one round looks at. Seams have one, corners of parts a few; more are joined in
/// the next round, when these have become one.
constexpr std::size_t most_companions = 16;
/// A round leaves a sixteenth of the points of a heap or less: this is enough for all numbers of 32 bits.
constexpr int most_rounds = 8;
/// Squares of distances from boxes may be this much too large.
constexpr double rounding = 1.0 + 1e-12;

struct Side {
  std::uint32_t low;
  std::uint32_t high;
};

/// Points on polygon sides that no other polygon has.
struct Border {
  std::vector<std::uint32_t> points;  ///< ascending
  std::vector<double> reach;          ///< of each point of the list: how near others count as the same
};

/// `distance` is the largest reach.
Border find_border(const PolygonList& list, double distance) {
  std::vector<Side> sides;
  sides.reserve(list.corners.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto polygon = list.polygon(i);
    std::uint32_t p = polygon.back();
    for (const std::uint32_t q : polygon) {
      sides.push_back({std::min(p, q), std::max(p, q)});
      p = q;
    }
  }
  const std::vector<Side> edges = in_edge_order(std::span<const Side>(sides));
  Border border;
  border.reach.assign(list.points.size(), distance);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) {
      ++j;
    }
    if (j - i == 1) {
      const double near = near_of_edge * length(list.points[edges[i].high] - list.points[edges[i].low]);
      for (const std::uint32_t p : {edges[i].low, edges[i].high}) {
        border.points.push_back(p);
        border.reach[p] = std::min(border.reach[p], near);
      }
    }
    i = j;
  }
  std::sort(border.points.begin(), border.points.end());
  border.points.erase(std::unique(border.points.begin(), border.points.end()), border.points.end());
  return border;
}

struct Pair {
  double distance;
  std::uint32_t a;
  std::uint32_t b;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

struct Pairs {
  std::vector<Pair> near;  ///< in order
  bool complete = true;    ///< no point had more companions than are looked at
};

/// Each point with its nearest companions within reach of both.
Pairs near_pairs(const PolygonList& list, const Border& border, const Context& context) {
  const BorderPoints others(list.points, border.points, border.reach);
  Pairs pairs;
  std::vector<Pair> nearest;  // a heap, the farthest on top
  for (std::size_t i = 0; i < border.points.size(); ++i) {
    if (i % 1024 == 0) {
      context.check();
    }
    const std::uint32_t p = border.points[i];
    const Vec3 at = list.points[p];
    nearest.clear();
    others.tree.nearest_first(
        at, border.reach[p],
        [&](double within, std::uint32_t node, double distance) {
          const double most = std::min(within, others.reach[node]);
          return distance <= rounding * most * most;
        },
        [&](double& within, std::uint32_t place) {
          const std::uint32_t q = others.points[place];
          const double apart = length(list.points[q] - at);
          if (q == p || apart > std::min(border.reach[p], border.reach[q])) {
            return;
          }
          nearest.push_back({apart, std::min(p, q), std::max(p, q)});
          std::push_heap(nearest.begin(), nearest.end());
          if (nearest.size() > most_companions) {
            pairs.complete = false;
            std::pop_heap(nearest.begin(), nearest.end());
            nearest.pop_back();
            within = nearest.front().distance;
          }
        });
    pairs.near.insert(pairs.near.end(), nearest.begin(), nearest.end());
  }
  std::sort(pairs.near.begin(), pairs.near.end());
  pairs.near.erase(std::unique(pairs.near.begin(), pairs.near.end()), pairs.near.end());
  return pairs;
}

/// Sets of joined points, each with the polygons that it touches.
class Clusters {
 public:
  Clusters(const PolygonList& list, const std::vector<Pair>& pairs)
      : sets_(list.points.size()), label_(list.points.size()) {
    std::iota(label_.begin(), label_.end(), 0U);
    std::vector<bool> wanted(list.points.size(), false);
    for (const Pair& pair : pairs) {
      wanted[pair.a] = wanted[pair.b] = true;
    }
    polygons_.resize(list.points.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const std::uint32_t p : list.polygon(i)) {
        const auto polygon = static_cast<std::uint32_t>(i);
        // A polygon that visits one point twice is in its list once.
        if (wanted[p] && (polygons_[p].empty() || polygons_[p].back() != polygon)) {
          polygons_[p].push_back(polygon);
          touches_.insert(key(p, polygon));
        }
      }
    }
  }
  /// Joins two sets unless a polygon would lose a corner by it. The smaller one goes into the larger one:
  /// each polygon moves O(log n) times.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = sets_.find(a);
    b = sets_.find(b);
    if (a == b) {
      return false;
    }
    std::uint32_t large = label_[a];
    std::uint32_t small = label_[b];
    if (polygons_[large].size() < polygons_[small].size()) {
      std::swap(large, small);
    }
    std::vector<std::uint32_t>& moved = polygons_[small];
    if (std::any_of(moved.begin(), moved.end(),
                    [&](std::uint32_t polygon) { return touches_.contains(key(large, polygon)); })) {
      return false;
    }
    for (const std::uint32_t polygon : moved) {
      polygons_[large].push_back(polygon);
      touches_.insert(key(large, polygon));
    }
    moved = {};
    sets_.join(a, b);
    label_[sets_.find(a)] = large;
    return true;
  }
  std::uint32_t find(std::uint32_t p) { return sets_.find(p); }

 private:
  static std::uint64_t key(std::uint32_t label, std::uint32_t polygon) {
    return std::uint64_t{label} << 32U | polygon;
  }
  DisjointSets sets_;
  std::vector<std::uint32_t> label_;  ///< of each set's representative: its place in polygons_
  std::vector<std::vector<std::uint32_t>> polygons_;  ///< each once
  std::unordered_set<std::uint64_t> touches_;         ///< asked only whether a key is there
};

}  // namespace

std::size_t join_border_points(PolygonList& list, double distance, const Context& context) {
  std::size_t gone = 0;
  for (int round = 0; distance > 0.0 && round < most_rounds; ++round) {
    const Pairs pairs = near_pairs(list, find_border(list, distance), context);
    if (pairs.near.empty()) {
      break;
    }
    Clusters clusters(list, pairs.near);
    const std::size_t before_round = gone;
    for (std::size_t i = 0; i < pairs.near.size(); ++i) {
      if (i % 1024 == 0) {
        context.check();
      }
      gone += clusters.join(pairs.near[i].a, pairs.near[i].b) ? 1U : 0U;
    }
    for (std::uint32_t& c : list.corners) {
      c = clusters.find(c);
    }
    if (pairs.complete || gone == before_round) {
      break;
    }
  }
  return gone;
}

}  // namespace ridgecraft::mesh
