// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/component_ties.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "base/delaunay_edges.hpp"
#include "base/disjoint_sets.hpp"

namespace ridgecraft::segment {
namespace {

/// A pair of vertices of two components, and how far apart they are.
struct Tie {
  double squared_length;
  std::uint32_t from;
  std::uint32_t to;

  bool operator<(const Tie& other) const {
    return std::tie(squared_length, from, to) < std::tie(other.squared_length, other.from, other.to);
  }
};

double squared_distance(Vec3 p, Vec3 q) {
  return dot(p - q, p - q);
}

/// A side of a facet, seen from one of its ends.
struct Side {
  std::uint32_t facet = none;
  std::uint32_t k = 0;
};

class Tying {
 public:
  explicit Tying(ScaledSurface& surface)
      : s_(&surface), real_facets_(surface.facet_count()), components_(surface.facet_count()) {
    for (std::uint32_t f = 0; f < s_->facet_count(); ++f) {
      for (const std::uint32_t g : s_->neighbors[f]) {
        if (g != none) {
          components_.join(f, g);
        }
      }
    }
  }

  void run() {
    std::vector<Tie> ties = candidates();
    std::sort(ties.begin(), ties.end());
    for (const Tie& tie : ties) {
      const std::uint32_t a = component_at(tie.from);
      const std::uint32_t b = component_at(tie.to);
      if (a != b) {
        join(tie);
        components_.join(a, b);
      }
    }
  }

 private:
  std::uint32_t component_at(std::uint32_t v) { return components_.find(s_->facets_at(v).front()); }

  /// Pairs of vertices of different components that hold a shortest tree between these.
  std::vector<Tie> candidates() {
    std::vector<std::uint32_t> used;
    std::vector<Vec3> points;
    for (std::uint32_t v = 0; v < s_->vertex_count(); ++v) {
      if (!s_->facets_at(v).empty()) {
        used.push_back(v);
        points.push_back(s_->points[v]);
      }
    }
    std::vector<Tie> ties;
    for (const auto& [i, j] : delaunay_edges(points)) {
      if (component_at(used[i]) != component_at(used[j])) {
        ties.push_back({squared_distance(points[i], points[j]), used[i], used[j]});
      }
    }
    return ties;
  }

  /// The side at a vertex that a ribbon begins at: best one between two facets of different polygons that has
  /// no ribbon yet, whose other end is nearest to where the ribbon leads.
  [[nodiscard]] Side side_at(std::uint32_t v, Vec3 target) const {
    Side best;
    std::pair<int, double> least{};
    for (const std::uint32_t f : s_->facets_at(v)) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t from = s_->corners[f][k];
        const std::uint32_t to = s_->corners[f][(k + 1) % 3];
        if (from != v && to != v) {
          continue;
        }
        const std::uint32_t g = s_->neighbors[f][k];
        const int rank = g == none ? 1 : s_->same_group(f, g) ? 3 : g >= real_facets_ ? 2 : 0;
        const std::pair<int, double> cost{rank, squared_distance(s_->points[from == v ? to : from], target)};
        if (best.facet == none || cost < least) {
          best = {f, k};
          least = cost;
        }
      }
    }
    return best;
  }

  /// The same side as its neighbour has it; none at a border.
  [[nodiscard]] Side beyond(Side side) const {
    const std::uint32_t g = s_->neighbors[side.facet][side.k];
    if (g == none) {
      return {};
    }
    const std::uint32_t to = s_->corners[side.facet][(side.k + 1) % 3];
    Side twin;
    for (std::uint32_t j = 0; j < 3; ++j) {
      if (s_->neighbors[g][j] == side.facet && (twin.facet == none || s_->corners[g][j] == to)) {
        twin = {g, j};
      }
    }
    return twin;
  }

  void connect(Side a, Side b) {
    if (a.facet != none) {
      s_->neighbors[a.facet][a.k] = b.facet;
    }
    if (b.facet != none) {
      s_->neighbors[b.facet][b.k] = a.facet;
    }
  }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    s_->corners.push_back({a, b, c});
    s_->neighbors.push_back({none, none, none});
    return static_cast<std::uint32_t>(s_->corners.size() - 1);
  }

  void join(const Tie& tie) {
    const auto& points = s_->points;
    const Side one = side_at(tie.from, points[tie.to]);
    Side two = side_at(tie.to, points[tie.from]);
    const auto ends = [&](Side side) {
      const auto& c = s_->corners[side.facet];
      return std::pair{c[side.k], c[(side.k + 1) % 3]};
    };
    const auto [a, b] = ends(one);
    if (const Side other = beyond(two); other.facet != none) {
      // The ribbon runs from a to d and from b to c: of the two facets there the one that doesn't twist it.
      const auto [c, d] = ends(two);
      if (length(points[a] - points[c]) + length(points[b] - points[d]) <
          length(points[a] - points[d]) + length(points[b] - points[c])) {
        two = other;
      }
    }
    const auto [c, d] = ends(two);
    const Side back_one = beyond(one);
    const Side back_two = beyond(two);
    const std::uint32_t first = add(b, a, d);
    const std::uint32_t second = add(b, d, c);
    connect({first, 0}, one);
    connect({first, 2}, {second, 0});
    connect({second, 1}, two);
    if (back_one.facet == none && back_two.facet == none) {
      return;
    }
    const std::uint32_t third = add(a, b, c);
    const std::uint32_t fourth = add(a, c, d);
    connect({third, 0}, back_one);
    connect({third, 1}, {second, 2});
    connect({third, 2}, {fourth, 0});
    connect({fourth, 1}, back_two);
    connect({fourth, 2}, {first, 1});
  }

  ScaledSurface* s_;
  std::size_t real_facets_;
  DisjointSets components_;  ///< of the facets that were there
};

}  // namespace

void tie_components(ScaledSurface& surface) {
  const std::size_t before = surface.facet_count();
  // Ribbons have no thickness: they must not turn the normals at their ends.
  const std::vector<Vec3> normals = surface.vertex_normals;
  Tying(surface).run();
  extend_groups(surface, before);
  index_and_orient(surface);
  surface.vertex_normals = normals;
}

}  // namespace ridgecraft::segment
