// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/correspondence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/no_index.hpp"
#include "base/order.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {
namespace {

/// Ends of an edge may be off by this share of its length: more would pair an edge with its neighbour.
constexpr double edge_fraction = 1.0 / 3.0;
/// Distances that differ by less than this share of the radius are the same, but for rounding.
constexpr double same_distance = 1e-6;
/// Squared differences of normals that differ by less are the same.
constexpr double same_normal = 1e-6;

/// The places where a surface has vertices; several vertices may share one.
struct Places {
  explicit Places(const mesh::Surface& surface)
      : points(surface.points().begin(), surface.points().end()), first(first_at_place(points)) {
    vertices.assign(points.size(), 0);
    for (std::uint32_t v = 0; v < first.size(); ++v) {
      ++vertices[first[v]];
      if (first[v] == v) {
        places.push_back(v);
      }
    }
  }
  std::vector<Vec3> points;
  std::vector<std::uint32_t> first;     ///< of each vertex: the first one at its place names it
  std::vector<std::uint32_t> vertices;  ///< at each place
  std::vector<std::uint32_t> places;
};

/// Finds the nearest of some points.
class Nearest {
 public:
  Nearest(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& numbers)
      : points_(points), tree_(points, numbers) {}

  /// The one with the smallest number among the nearest; none beyond the radius.
  [[nodiscard]] std::uint32_t operator()(Vec3 p, double radius) const {
    double least = radius * radius;
    std::uint32_t best = no_index;
    tree_.search(
        p, [&](double distance) { return distance <= least; },
        [&](std::uint32_t i) {
          const Vec3 d = points_[i] - p;
          if (dot(d, d) < least || (dot(d, d) == least && i < best)) {
            least = dot(d, d);
            best = i;
          }
        });
    return best;
  }

 private:
  const std::vector<Vec3>& points_;
  NearbyPoints tree_;
};

using Triple = std::array<std::uint32_t, 3>;

/// Turned so that the smallest stands first: faces with the same corners and outside are the same then.
Triple turned(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

class Matcher {
 public:
  Matcher(const mesh::Surface& from, const mesh::Surface& to, const Isometry& isometry, double radius)
      : from_(from), to_(to), isometry_(isometry), radius_(radius), here_(from), there_(to) {}

  Correspondence run() {
    result_.vertex.resize(from_.vertex_count());
    result_.edge.resize(from_.edge_count());
    result_.face.resize(from_.face_count());
    match_places();
    match_faces();
    edges_of_faces();
    other_edges();
    match_vertices();
    result_.whole = is_whole();
    return std::move(result_);
  }

 private:
  void match_places() {
    place_.assign(here_.points.size(), no_index);
    const Nearest there(there_.points, there_.places);
    const Nearest here(here_.points, here_.places);
    const Isometry back = isometry_.inverse();
    for (const std::uint32_t p : here_.places) {
      const Vec3 image = isometry_(here_.points[p]);
      const std::uint32_t q = there(image, radius_);
      if (q != no_index && here(back(there_.points[q]), radius_) == p) {
        place_[p] = q;
        result_.farthest = std::max(result_.farthest, length(image - there_.points[q]));
      } else {
        result_.farthest = INFINITY;
      }
    }
    for (std::uint32_t v = 0; v < place_.size(); ++v) {
      place_[v] = place_[here_.first[v]];
    }
  }

  void match_faces() {
    std::vector<std::pair<Triple, std::uint32_t>> keys;
    keys.reserve(to_.face_count());
    for (const FaceId f : ids<FaceId>(to_.face_count())) {
      const auto [a, b, c] = to_.vertices(f);
      keys.emplace_back(turned({there_.first[a.value()], there_.first[b.value()], there_.first[c.value()]}),
                        f.value());
    }
    std::sort(keys.begin(), keys.end());
    std::vector<bool> used(keys.size(), false);
    for (const FaceId f : ids<FaceId>(from_.face_count())) {
      const auto [a, b, c] = from_.vertices(f);
      Triple image{place_[a.value()], place_[b.value()], place_[c.value()]};
      if (isometry_.mirrors) {
        std::swap(image[1], image[2]);
      }
      image = turned(image);
      auto found = std::lower_bound(keys.begin(), keys.end(), std::pair(image, std::uint32_t{0}));
      while (found != keys.end() && found->first == image &&
             used[static_cast<std::size_t>(found - keys.begin())]) {
        ++found;
      }
      if (image[2] != no_index && image[1] != no_index && found != keys.end() && found->first == image) {
        used[static_cast<std::size_t>(found - keys.begin())] = true;
        result_.face[f] = FaceId(found->second);
      }
    }
  }

  /// The corner of f's partner that belongs to corner c of f; the partner must exist.
  [[nodiscard]] CornerId corner_there(CornerId c) const {
    const FaceId g = result_.face[mesh::face_of(c)];
    const std::uint32_t wanted = place_[from_.vertex(c).value()];
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId d = mesh::corner(g, k);
      if (there_.first[to_.vertex(d).value()] == wanted) {
        return d;
      }
    }
    return {};
  }

  /// The side of f's partner that side c of f lies on.
  [[nodiscard]] CornerId side_there(CornerId c) const {
    return corner_there(isometry_.mirrors ? mesh::next(c) : c);
  }

  void match_vertices() {
    std::vector<bool> used(to_.vertex_count(), false);
    const auto pair = [&](VertexId v, VertexId w) {
      if (w.valid() && !used[w.value()]) {
        used[w.value()] = true;
        result_.vertex[v] = w;
      }
    };
    for (const VertexId v : ids<VertexId>(from_.vertex_count())) {
      const std::uint32_t q = place_[v.value()];
      if (q == no_index) {
        continue;
      }
      if (here_.vertices[here_.first[v.value()]] == 1 && there_.vertices[q] == 1) {
        pair(v, VertexId(q));
        continue;
      }
      pair(v, vertex_by_neighbours(v));
    }
  }

  /// What the partners of its faces, or else of its edges, say.
  [[nodiscard]] VertexId vertex_by_neighbours(VertexId v) const {
    for (const CornerId c : from_.corners_at(v)) {
      if (result_.face[mesh::face_of(c)].valid()) {
        return to_.vertex(corner_there(c));
      }
    }
    for (const CornerId c : from_.corners_at(v)) {
      for (const CornerId side : {c, mesh::previous(c)}) {
        const EdgeId partner = result_.edge[from_.edge(side)];
        if (!partner.valid()) {
          continue;
        }
        const CornerId there = to_.sides(partner)[0];
        for (const VertexId w : {to_.vertex(there), to_.vertex(mesh::next(there))}) {
          if (there_.first[w.value()] == place_[v.value()]) {
            return w;
          }
        }
      }
    }
    return {};
  }

  void edges_of_faces() {
    used_edge_.assign(to_.edge_count(), false);
    for (const FaceId f : ids<FaceId>(from_.face_count())) {
      for (unsigned k = 0; k < 3 && result_.face[f].valid(); ++k) {
        const CornerId c = mesh::corner(f, k);
        const EdgeId partner = to_.edge(side_there(c));
        if (!result_.edge[from_.edge(c)].valid() && !used_edge_[partner.value()]) {
          result_.edge[from_.edge(c)] = partner;
          used_edge_[partner.value()] = true;
        }
      }
    }
  }

  void other_edges() {
    const auto& edges = result_.edge.items();
    if (std::all_of(edges.begin(), edges.end(), [](EdgeId e) { return e.valid(); })) {
      return;
    }
    const IdVector<EdgeId, EdgeId> matched = match_edges(from_, to_, isometry_, radius_);
    for (const EdgeId e : ids<EdgeId>(from_.edge_count())) {
      const EdgeId partner = matched[e];
      if (!result_.edge[e].valid() && partner.valid() && !used_edge_[partner.value()]) {
        result_.edge[e] = partner;
        used_edge_[partner.value()] = true;
      }
    }
  }

  [[nodiscard]] bool is_whole() const {
    if (from_.face_count() != to_.face_count()) {
      return false;
    }
    for (const FaceId f : ids<FaceId>(from_.face_count())) {
      if (!result_.face[f].valid()) {
        return false;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        const FaceId beyond = from_.neighbor(c);
        const FaceId partner = to_.neighbor(side_there(c));
        if (beyond.valid() != partner.valid() || (beyond.valid() && result_.face[beyond] != partner)) {
          return false;
        }
      }
    }
    return true;
  }

  const mesh::Surface& from_;
  const mesh::Surface& to_;
  const Isometry& isometry_;
  double radius_;
  Places here_;
  Places there_;
  std::vector<std::uint32_t> place_;  ///< of each vertex of from_: the place of to_ that its image lies on
  std::vector<bool> used_edge_;
  Correspondence result_;
};

struct Ends {
  Vec3 a;
  Vec3 b;
};

Ends ends(const mesh::Surface& surface, EdgeId e) {
  const CornerId c = surface.sides(e)[0];
  return {surface.point(surface.vertex(c)), surface.point(surface.vertex(mesh::next(c)))};
}

/// Sum of the normals beside an edge: it tells edges in one place apart.
Vec3 outwards(const mesh::Surface& surface, EdgeId e) {
  const auto [c, d] = surface.sides(e);
  const Vec3 n = surface.normal(mesh::face_of(c));
  return d.valid() ? n + surface.normal(mesh::face_of(d)) : n;
}

/// Two edges that may belong together.
struct Pairing {
  double distance;  ///< of the farther ends, in steps of what counts as equal
  double apart;     ///< of their normals, squared, in such steps, too
  std::uint32_t from;
  std::uint32_t to;
  friend auto operator<=>(const Pairing&, const Pairing&) = default;
};

std::vector<Pairing> near_pairs(const mesh::Surface& from, const mesh::Surface& to, const Isometry& isometry,
                                double radius) {
  std::vector<Vec3> middles;
  middles.reserve(to.edge_count());
  for (const EdgeId e : ids<EdgeId>(to.edge_count())) {
    const auto [a, b] = ends(to, e);
    middles.push_back(0.5 * (a + b));
  }
  std::vector<std::uint32_t> numbers(middles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  const NearbyPoints tree(middles, numbers);
  std::vector<Pairing> pairs;
  const double step = same_distance * radius;
  for (const EdgeId e : ids<EdgeId>(from.edge_count())) {
    const auto edge_ends = ends(from, e);
    const Vec3 a = isometry(edge_ends.a);
    const Vec3 b = isometry(edge_ends.b);
    const Vec3 middle = 0.5 * (a + b);
    const double reach = std::min(radius, edge_fraction * from.length(e));
    const Vec3 own = isometry.turn(outwards(from, e));
    tree.search(
        middle, [&](double distance) { return distance <= reach * reach; },
        [&](std::uint32_t i) {
          const auto [p, q] = ends(to, EdgeId(i));
          const double straight = std::max(length(p - a), length(q - b));
          const double crossed = std::max(length(q - a), length(p - b));
          const double distance = std::min(straight, crossed);
          if (distance <= reach) {
            const Vec3 d = own - outwards(to, EdgeId(i));
            pairs.push_back({step > 0.0 ? std::round(distance / step) : 0.0,
                             std::round(dot(d, d) / same_normal), e.value(), i});
          }
        });
  }
  return pairs;
}

}  // namespace

IdVector<EdgeId, EdgeId> match_edges(const mesh::Surface& from, const mesh::Surface& to,
                                     const Isometry& isometry, double radius) {
  std::vector<Pairing> pairs = near_pairs(from, to, isometry, radius);
  std::vector<double> nearest_from(from.edge_count(), INFINITY);
  std::vector<double> nearest_to(to.edge_count(), INFINITY);
  for (const Pairing& p : pairs) {
    nearest_from[p.from] = std::min(nearest_from[p.from], p.distance);
    nearest_to[p.to] = std::min(nearest_to[p.to], p.distance);
  }
  std::sort(pairs.begin(), pairs.end());
  IdVector<EdgeId, EdgeId> partner(from.edge_count());
  std::vector<bool> used(to.edge_count(), false);
  for (const Pairing& p : pairs) {
    const bool mutual = p.distance <= nearest_from[p.from] + 1.0 && p.distance <= nearest_to[p.to] + 1.0;
    if (mutual && !partner[EdgeId(p.from)].valid() && !used[p.to]) {
      partner[EdgeId(p.from)] = EdgeId(p.to);
      used[p.to] = true;
    }
  }
  return partner;
}

Correspondence correspond(const mesh::Surface& from, const mesh::Surface& to, const Isometry& isometry,
                          double radius) {
  return Matcher(from, to, isometry, radius).run();
}

}  // namespace ridgecraft::prepare
