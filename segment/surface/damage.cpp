// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/damage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "base/delaunay.hpp"
#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Area, in squared ball radii, up to which a hole is damage: that of a circle with a perimeter of 2. Ragged
/// holes round crumbs are long but small. Perimeters of 0.5 and 10 gave the same parts.
constexpr double largest_hole = 1.0 / std::numbers::pi;
constexpr double damaged_border_share = 0.1;
constexpr std::size_t damaged_components = 20;
/// A piece without any neighbour is tied to the rest when that is at most this many of its longest edges
/// away.
constexpr double longest_tie = 4.0;
/// ... and it has at most this share of the largest piece's facets: what is larger is an object of its own.
constexpr std::size_t tied_ratio = 20;

/// One edge of a hole, from its vertex to the next one's, and the side of the facet behind it.
struct HoleEdge {
  std::uint32_t vertex;
  std::uint32_t facet;
  unsigned side;
};

/// Repair gives each fan of facets a vertex of its own; here they are one again.
void join_border_vertices(ScaledSurface& s) {
  std::map<std::tuple<double, double, double>, std::uint32_t> at;
  std::vector<std::uint32_t> becomes(s.vertex_count(), no_index);
  for (std::size_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      if (s.neighbors[f][k] != no_index) {
        continue;
      }
      for (const std::uint32_t v : {s.corners[f][k], s.corners[f][(k + 1) % 3]}) {
        const Vec3 p = s.points[v];
        becomes[v] = at.try_emplace({p.x, p.y, p.z}, v).first->second;
      }
    }
  }
  for (auto& corners : s.corners) {
    for (std::uint32_t& v : corners) {
      v = becomes[v] == no_index ? v : becomes[v];
    }
  }
}

/// Pieces of which all neighbours are gone, even those at corners, get a facet that leads to the nearest
/// border vertex of a larger piece, so that the hole around them runs along them, too.
class CrumbTies {
 public:
  explicit CrumbTies(ScaledSurface& surface) : s_(&surface), pieces_(surface.vertex_count()) {
    for (std::uint32_t f = 0; f < s_->facet_count(); ++f) {
      const auto& [a, b, c] = s_->corners[f];
      pieces_.join(a, b);
      pieces_.join(b, c);
    }
    size_.assign(s_->vertex_count(), 0);
    for (std::uint32_t f = 0; f < s_->facet_count(); ++f) {
      ++size_[pieces_.find(s_->corners[f][0])];
      for (unsigned k = 0; k < 3; ++k) {
        if (s_->neighbors[f][k] == no_index) {
          border_.push_back(s_->corners[f][k]);
        }
      }
    }
    const auto& points = s_->points;
    std::sort(border_.begin(), border_.end(), [&](std::uint32_t v, std::uint32_t w) {
      return points[v].x != points[w].x ? points[v].x < points[w].x : v < w;
    });
  }

  void run() {
    const std::size_t largest = *std::max_element(size_.begin(), size_.end());
    std::map<std::uint32_t, std::vector<std::uint32_t>> crumbs;
    const auto facets = static_cast<std::uint32_t>(s_->facet_count());
    for (std::uint32_t f = 0; f < facets; ++f) {
      const std::uint32_t piece = pieces_.find(s_->corners[f][0]);
      if (size_[piece] * tied_ratio <= largest) {
        crumbs[piece].push_back(f);
      }
    }
    for (const auto& [piece, members] : crumbs) {
      tie(piece, members);
    }
  }

 private:
  void tie(std::uint32_t piece, const std::vector<std::uint32_t>& members) {
    const auto& points = s_->points;
    double reach = 0.0;
    for (const std::uint32_t f : members) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto& c = s_->corners[f];
        reach = std::max(reach, longest_tie * length(points[c[(k + 1) % 3]] - points[c[k]]));
      }
    }
    HoleEdge best{no_index, no_index, 0};
    double least = 2.0 * reach;
    for (const std::uint32_t f : members) {
      for (unsigned k = 0; k < 3; ++k) {
        if (s_->neighbors[f][k] == no_index) {
          find_nearest(piece, {no_index, f, k}, best, least);
        }
      }
    }
    if (best.vertex == no_index) {
      return;
    }
    const auto& c = s_->corners[best.facet];
    const std::array<std::uint32_t, 3> corners{c[(best.side + 1) % 3], c[best.side], best.vertex};
    s_->neighbors[best.facet][best.side] = static_cast<std::uint32_t>(s_->facet_count());
    s_->corners.push_back(corners);
    s_->neighbors.push_back({best.facet, no_index, no_index});
  }

  /// The border vertex of another, larger piece with the least sum of distances from the ends of a side.
  void find_nearest(std::uint32_t piece, HoleEdge from, HoleEdge& best, double& least) {
    const auto& points = s_->points;
    const Vec3 p = points[s_->corners[from.facet][from.side]];
    const Vec3 q = points[s_->corners[from.facet][(from.side + 1) % 3]];
    auto at = std::lower_bound(border_.begin(), border_.end(), p.x - least,
                               [&](std::uint32_t v, double x) { return points[v].x < x; });
    for (; at != border_.end() && points[*at].x <= p.x + least; ++at) {
      const std::uint32_t other = pieces_.find(*at);
      const double sum = length(points[*at] - p) + length(points[*at] - q);
      if (sum < least && (size_[other] > size_[piece] || (size_[other] == size_[piece] && other < piece))) {
        least = sum;
        best = {*at, from.facet, from.side};
      }
    }
  }

  ScaledSurface* s_;
  DisjointSets pieces_;                ///< of vertices: those of one piece
  std::vector<std::size_t> size_;      ///< facets, by the piece's root
  std::vector<std::uint32_t> border_;  ///< vertices by x
};

class Closer {
 public:
  explicit Closer(ScaledSurface& surface) : s_(&surface) {
    for (std::uint32_t f = 0; f < s_->facet_count(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        if (s_->neighbors[f][k] == no_index) {
          arriving_[s_->corners[f][(k + 1) % 3]].push_back({f, k, false});
        }
      }
    }
  }

  void run() {
    const auto facets = static_cast<std::uint32_t>(s_->facet_count());
    for (std::uint32_t f = 0; f < facets; ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        if (Side* side = find(f, k); side != nullptr && !side->taken) {
          const std::vector<HoleEdge> hole = follow(f, k);
          if (!hole.empty() && is_small(hole)) {
            close(hole);
          }
        }
      }
    }
  }

 private:
  struct Side {
    std::uint32_t facet;
    unsigned side;
    bool taken;
  };

  Side* find(std::uint32_t f, unsigned k) {
    const auto at = arriving_.find(s_->corners[f][(k + 1) % 3]);
    if (at == arriving_.end()) {
      return nullptr;
    }
    for (Side& side : at->second) {
      if (side.facet == f && side.side == k) {
        return &side;
      }
    }
    return nullptr;
  }

  /// The hole beyond a side. Its edges run against the facets' sides; empty when it doesn't close.
  std::vector<HoleEdge> follow(std::uint32_t f, unsigned k) {
    std::vector<HoleEdge> hole{{s_->corners[f][(k + 1) % 3], f, k}};
    // A vertex where several fans meet is passed several times, so the first side stays open to be chosen:
    // only then the hole is closed. Else a face that hangs on a vertex would be closed by itself.
    for (;;) {
      const std::uint32_t previous = hole.back().vertex;
      const std::uint32_t at = s_->corners[hole.back().facet][hole.back().side];
      Side* side = next_side(at, previous);
      if (side == nullptr) {
        find(f, k)->taken = true;
        return {};
      }
      side->taken = true;
      if (side->facet == f && side->side == k) {
        return hole;
      }
      hole.push_back({at, side->facet, side->side});
    }
  }

  /// Of the open sides that arrive at a vertex, the first one when turning clockwise from the edge to
  /// `previous`.
  Side* next_side(std::uint32_t at, std::uint32_t previous) {
    const auto found = arriving_.find(at);
    if (found == arriving_.end()) {
      return nullptr;
    }
    const Vec3 n = s_->vertex_normals[at];
    const Vec3 from = s_->points[previous] - s_->points[at];
    Side* best = nullptr;
    double least = INFINITY;
    for (Side& side : found->second) {
      if (side.taken) {
        continue;
      }
      const Vec3 to = s_->points[s_->corners[side.facet][side.side]] - s_->points[at];
      double angle = elementary::atan2(dot(n, cross(to, from)), dot(from, to) - dot(n, from) * dot(n, to));
      angle += angle <= 0.0 ? 2.0 * std::numbers::pi : 0.0;
      if (angle < least) {
        least = angle;
        best = &side;
      }
    }
    return best;
  }

  [[nodiscard]] bool is_small(const std::vector<HoleEdge>& hole) const {
    Vec3 area;
    const Vec3 from = s_->points[hole.front().vertex];
    for (const HoleEdge& e : hole) {
      const auto& c = s_->corners[e.facet];
      area += 0.5 * cross(s_->points[c[e.side]] - from, s_->points[c[(e.side + 1) % 3]] - from);
    }
    return length(area) <= largest_hole;
  }

  void connect(const HoleEdge& a, const HoleEdge& b) {
    if (a.facet != b.facet) {
      s_->neighbors[a.facet][a.side] = b.facet;
      s_->neighbors[b.facet][b.side] = a.facet;
    }
  }

  /// Cuts off corners, the one with the shortest diagonal first.
  void close(std::vector<HoleEdge> hole) {
    while (hole.size() > 2) {
      const std::size_t n = hole.size();
      std::size_t best = 0;
      double least = INFINITY;
      for (std::size_t i = 0; i < n; ++i) {
        const double diagonal =
            length(s_->points[hole[(i + n - 1) % n].vertex] - s_->points[hole[(i + 1) % n].vertex]);
        if (diagonal < least) {
          least = diagonal;
          best = i;
        }
      }
      HoleEdge& before = hole[(best + n - 1) % n];
      const HoleEdge corner = hole[best];
      const HoleEdge& after = hole[(best + 1) % n];
      if (before.vertex == after.vertex) {
        // There and back along one line: the two sides meet.
        connect(before, corner);
        const std::size_t second = (best + n - 1) % n;
        hole.erase(hole.begin() + static_cast<std::ptrdiff_t>(std::max(best, second)));
        hole.erase(hole.begin() + static_cast<std::ptrdiff_t>(std::min(best, second)));
        continue;
      }
      const auto f = static_cast<std::uint32_t>(s_->facet_count());
      s_->corners.push_back({before.vertex, corner.vertex, after.vertex});
      s_->neighbors.push_back({no_index, no_index, no_index});
      connect({0, f, 0}, before);
      connect({0, f, 1}, corner);
      before.facet = f;
      before.side = 2;
      hole.erase(hole.begin() + static_cast<std::ptrdiff_t>(best));
    }
    if (hole.size() == 2) {
      connect(hole[0], hole[1]);
    }
  }

  ScaledSurface* s_;
  std::map<std::uint32_t, std::vector<Side>> arriving_;
};

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
  std::uint32_t facet = no_index;
  std::uint32_t k = 0;
};

class Tying {
 public:
  explicit Tying(ScaledSurface& surface)
      : s_(&surface), real_facets_(surface.facet_count()), components_(surface.facet_count()) {
    for (std::uint32_t f = 0; f < s_->facet_count(); ++f) {
      for (const std::uint32_t g : s_->neighbors[f]) {
        if (g != no_index) {
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
        const int rank = g == no_index ? 1 : s_->same_group(f, g) ? 3 : g >= real_facets_ ? 2 : 0;
        const std::pair<int, double> cost{rank, squared_distance(s_->points[from == v ? to : from], target)};
        if (best.facet == no_index || cost < least) {
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
    if (g == no_index) {
      return {};
    }
    const std::uint32_t to = s_->corners[side.facet][(side.k + 1) % 3];
    Side twin;
    for (std::uint32_t j = 0; j < 3; ++j) {
      if (s_->neighbors[g][j] == side.facet && (twin.facet == no_index || s_->corners[g][j] == to)) {
        twin = {g, j};
      }
    }
    return twin;
  }

  void connect(Side a, Side b) {
    if (a.facet != no_index) {
      s_->neighbors[a.facet][a.k] = b.facet;
    }
    if (b.facet != no_index) {
      s_->neighbors[b.facet][b.k] = a.facet;
    }
  }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    s_->corners.push_back({a, b, c});
    s_->neighbors.push_back({no_index, no_index, no_index});
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
    if (const Side other = beyond(two); other.facet != no_index) {
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
    if (back_one.facet == no_index && back_two.facet == no_index) {
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

bool looks_damaged(const mesh::Surface& surface) {
  if (surface.component_count() <= damaged_components) {
    return false;
  }
  std::size_t border = 0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (unsigned k = 0; k < 3; ++k) {
      border += surface.neighbor(mesh::corner(f, k)).valid() ? 0U : 1U;
    }
  }
  return static_cast<double>(border) > damaged_border_share * static_cast<double>(surface.edge_count());
}

void close_holes(ScaledSurface& s) {
  const std::size_t before = s.facet_count();
  join_border_vertices(s);
  CrumbTies(s).run();
  index_and_orient(s);
  Closer(s).run();
  extend_groups(s, before);
  index_and_orient(s);
}

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
