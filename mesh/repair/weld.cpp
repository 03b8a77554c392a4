// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/weld.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/order.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {
namespace {

// Points on borders, each with a reach, to be found by place. Private to mesh/.

/// Where companions of a point and points on an edge are looked up. O(n log n) to build.
struct BorderPoints {
  /// `numbers`: those of the list's points that lie on borders; `reach_of`: of each point of the list.
  BorderPoints(const std::vector<Vec3>& list, const std::vector<std::uint32_t>& numbers,
               const std::vector<double>& reach_of)
      : tree(
            numbers.size(),
            [&](std::uint32_t i) {
              return Box3{list[numbers[i]], list[numbers[i]]};
            },
            [&](std::uint32_t i) { return list[numbers[i]]; }),
        reach(tree.largest_below([&](std::uint32_t i) { return reach_of[numbers[i]]; })) {
    points.reserve(numbers.size());
    for (const std::uint32_t i : tree.order()) {
      points.push_back(numbers[i]);
    }
  }

  BoxTree<Box3> tree;
  std::vector<double> reach;          ///< per node of the tree, the largest of its points
  std::vector<std::uint32_t> points;  ///< numbers in the list, in the order of the tree
};

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
  for_each_edge(edges, [&](std::size_t i, std::size_t j) {
    if (j - i == 1) {
      const double near = near_of_edge * length(list.points[edges[i].high] - list.points[edges[i].low]);
      for (const std::uint32_t p : {edges[i].low, edges[i].high}) {
        border.points.push_back(p);
        border.reach[p] = std::min(border.reach[p], near);
      }
    }
  });
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

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Whether the line from a, `size` long, meets the box.
bool meets(Vec3 a, Vec3 along, double size, const Box3& box) {
  double first = 0.0;
  double last = size;
  const auto clip = [&](double from, double step, double low, double high) {
    if (step == 0.0) {
      return low <= from && from <= high;
    }
    const double s = (low - from) / step;
    const double t = (high - from) / step;
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
    return first <= last;
  };
  return clip(a.x, along.x, box.low.x, box.high.x) && clip(a.y, along.y, box.low.y, box.high.y) &&
         clip(a.z, along.z, box.low.z, box.high.z);
}

/// One pass: each triangle is divided at one side at most.
class Pass {
 public:
  Pass(TriangleList& list, const std::vector<EdgeUse>& uses, double distance)
      : list_(list), distance_(distance), reach_(list.points.size(), distance) {
    for_each_edge(uses, [&](std::size_t i, std::size_t j) {
      if (j - i == 1) {
        border_.push_back(uses[i]);
        edges_.emplace_back(uses[i].low, uses[i].high);
        points_.push_back(uses[i].low);
        points_.push_back(uses[i].high);
        const double near = near_of_edge * length(list_.points[uses[i].high] - list_.points[uses[i].low]);
        for (const std::uint32_t p : {uses[i].low, uses[i].high}) {
          reach_[p] = std::min(reach_[p], near);
        }
      }
    });
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  std::size_t run(const Context& context) {
    if (border_.empty()) {
      return 0;
    }
    const BorderPoints near(list_.points, points_, reach_);
    std::vector<bool> divided(list_.triangles.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 0; i < border_.size(); ++i) {
      if (i % 256 == 0) {
        context.check();
      }
      if (!divided[border_[i].triangle]) {
        const std::vector<std::uint32_t> on = points_on(border_[i], near);
        if (closes_seam(border_[i], on)) {
          divided[border_[i].triangle] = true;
          divide(border_[i], on);
          count += on.size();
        }
      }
    }
    return count;
  }

 private:
  /// Border points strictly between the ends, in order from corner `side` on.
  [[nodiscard]] std::vector<std::uint32_t> points_on(const EdgeUse& use, const BorderPoints& near) const {
    const Triangle& t = list_.triangles[use.triangle];
    const Vec3 a = list_.points[t.points[use.side]];
    const Vec3 b = list_.points[t.points[(use.side + 1U) % 3]];
    const double size = length(b - a);
    if (!(size > 2.0 * distance_)) {
      return {};
    }
    const Vec3 along = (b - a) / size;
    std::vector<std::pair<double, std::uint32_t>> found;
    near.tree.search(
        [&](std::uint32_t node) {
          // Twice the reach: computed distances may be a little too small.
          const double reach = 2.0 * near.reach[node];
          const Box3& box = near.tree.box(node);
          const Vec3 wider{reach, reach, reach};
          return meets(a, along, size, {box.low - wider, box.high + wider});
        },
        [&](std::uint32_t place) {
          const std::uint32_t p = near.points[place];
          const double t_along = dot(list_.points[p] - a, along);
          if (std::find(t.points.begin(), t.points.end(), p) == t.points.end() && t_along > distance_ &&
              t_along < size - distance_ && length(list_.points[p] - a - t_along * along) <= reach_[p]) {
            found.emplace_back(t_along, p);
          }
        });
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> on;
    for (const auto& [place, p] : found) {
      on.push_back(p);
    }
    return on;
  }

  [[nodiscard]] bool is_border(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges_.begin(), edges_.end(), edge(a, b));
  }

  [[nodiscard]] bool closes_seam(const EdgeUse& use, const std::vector<std::uint32_t>& on) const {
    if (on.empty()) {
      return false;
    }
    const Triangle& t = list_.triangles[use.triangle];
    std::uint32_t from = t.points[use.side];
    for (const std::uint32_t p : on) {
      if (is_border(from, p)) {
        return true;
      }
      from = p;
    }
    return is_border(from, t.points[(use.side + 1U) % 3]);
  }

  void divide(const EdgeUse& use, const std::vector<std::uint32_t>& on) {
    const Triangle whole = list_.triangles[use.triangle];
    const std::size_t second = (use.side + 1U) % 3;
    Triangle part = whole;
    part.points[second] = on.front();
    list_.triangles[use.triangle] = part;
    for (std::size_t i = 0; i < on.size(); ++i) {
      part.points[use.side] = on[i];
      part.points[second] = i + 1 < on.size() ? on[i + 1] : whole.points[second];
      list_.triangles.push_back(part);
    }
  }

  TriangleList& list_;
  double distance_;
  std::vector<double> reach_;  ///< of each point of the list: how near to an edge it lies on it
  std::vector<EdgeUse> border_;
  std::vector<Edge> edges_;  ///< of the border, sorted as edge_uses() sorts
  std::vector<std::uint32_t> points_;
};

}  // namespace

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

std::size_t join_t_junctions(TriangleList& list, std::vector<EdgeUse>& uses, double distance,
                             const Context& context) {
  // Three sides need three passes; more are for parts of what was divided.
  constexpr int passes = 6;
  std::size_t count = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const std::size_t now = Pass(list, uses, distance).run(context);
    if (now == 0) {
      break;
    }
    uses = edge_uses(list.triangles);
    count += now;
  }
  return count;
}

}  // namespace ridgecraft::mesh
