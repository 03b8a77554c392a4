// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/disjoint_sets.hpp"
#include "mesh/edge_order.hpp"
#include "mesh/point_cells.hpp"

namespace ridgecraft::mesh {
namespace {

bool before(Vec3 a, Vec3 b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

std::size_t join_equal_points(PolygonList& list) {
  std::vector<std::uint8_t> used(list.points.size(), 0);
  for (const std::uint32_t c : list.corners) {
    used[c] = 1;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < list.points.size(); ++i) {
    if (used[i] != 0) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = list.points[a];
    const Vec3 q = list.points[b];
    return before(p, q) || (!before(q, p) && a < b);
  });
  std::vector<std::uint32_t> stays(list.points.size());
  std::iota(stays.begin(), stays.end(), 0U);
  std::size_t gone = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (list.points[order[k]] == list.points[order[k - 1]]) {
      stays[order[k]] = stays[order[k - 1]];
      ++gone;
    }
  }
  if (gone > 0) {
    for (std::uint32_t& c : list.corners) {
      c = stays[c];
    }
  }
  return gone;
}

namespace {

struct Edge {
  std::uint32_t low;
  std::uint32_t high;
};

/// Points on polygon sides that no other polygon has, ascending.
std::vector<std::uint32_t> border_points(const PolygonList& list) {
  std::vector<Edge> sides;
  sides.reserve(list.corners.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto polygon = list.polygon(i);
    std::uint32_t p = polygon.back();
    for (const std::uint32_t q : polygon) {
      sides.push_back({std::min(p, q), std::max(p, q)});
      p = q;
    }
  }
  const std::vector<Edge> edges = in_edge_order(std::span<const Edge>(sides),
                                                [](const Edge& a, const Edge& b) { return a.high < b.high; });
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) {
      ++j;
    }
    if (j - i == 1) {
      points.push_back(edges[i].low);
      points.push_back(edges[i].high);
    }
    i = j;
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

struct Pair {
  double distance;
  std::uint32_t a;
  std::uint32_t b;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

std::vector<Pair> near_pairs(const PolygonList& list, const std::vector<std::uint32_t>& border,
                             double distance, const Context& context) {
  const PointCells cells(list.points, border, distance);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < border.size(); ++i) {
    if (i % 1024 == 0) {
      context.check();
    }
    cells.near(list.points[border[i]], [&](std::uint32_t q) {
      const double apart = length(list.points[q] - list.points[border[i]]);
      if (border[i] < q && apart <= distance) {
        pairs.push_back({apart, border[i], q});
      }
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Sets of joined points, each with the polygons that it touches.
class Clusters {
 public:
  Clusters(const PolygonList& list, const std::vector<Pair>& pairs) : sets_(list.points.size()) {
    std::vector<bool> wanted(list.points.size(), false);
    for (const Pair& pair : pairs) {
      wanted[pair.a] = wanted[pair.b] = true;
    }
    polygons_.resize(list.points.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const std::uint32_t p : list.polygon(i)) {
        if (wanted[p]) {
          polygons_[p].push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
  }
  /// Joins two sets unless a polygon would lose a corner by it.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = sets_.find(a);
    b = sets_.find(b);
    if (a == b) {
      return false;
    }
    std::vector<std::uint32_t> both;
    std::merge(polygons_[a].begin(), polygons_[a].end(), polygons_[b].begin(), polygons_[b].end(),
               std::back_inserter(both));
    // A polygon that visits one point twice is in its list twice: only new repeats count.
    const auto repeats = [](const std::vector<std::uint32_t>& v) {
      std::size_t n = 0;
      for (std::size_t i = 1; i < v.size(); ++i) {
        n += v[i] == v[i - 1] ? 1U : 0U;
      }
      return n;
    };
    if (repeats(both) != repeats(polygons_[a]) + repeats(polygons_[b])) {
      return false;
    }
    sets_.join(a, b);
    polygons_[sets_.find(a)] = std::move(both);
    return true;
  }
  std::uint32_t find(std::uint32_t p) { return sets_.find(p); }

 private:
  DisjointSets sets_;
  std::vector<std::vector<std::uint32_t>> polygons_;
};

}  // namespace

std::size_t join_border_points(PolygonList& list, double distance, const Context& context) {
  if (!(distance > 0.0)) {
    return 0;
  }
  const std::vector<Pair> pairs = near_pairs(list, border_points(list), distance, context);
  if (pairs.empty()) {
    return 0;
  }
  Clusters clusters(list, pairs);
  std::size_t gone = 0;
  for (const Pair& pair : pairs) {
    gone += clusters.join(pair.a, pair.b) ? 1U : 0U;
  }
  for (std::uint32_t& c : list.corners) {
    c = clusters.find(c);
  }
  return gone;
}

}  // namespace ridgecraft::mesh
