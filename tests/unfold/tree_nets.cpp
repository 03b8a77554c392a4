// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tree_nets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

#include "base/context.hpp"
#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "unfold/net/chains.hpp"

namespace ridgecraft::test {

using mesh::Surface;
using unfold::EdgeUse;
using unfold::Nets;

namespace {

void shuffle(std::vector<EdgeId>& edges, Random& random) {
  for (std::size_t i = edges.size(); i > 1; --i) {
    std::swap(edges[i - 1], edges[random.below(static_cast<std::uint32_t>(i))]);
  }
}

/// Third corner of a triangle of the given side lengths to the left of p -> q.
Vec2 apex(Vec2 p, Vec2 q, double pq, double qr, double rp) {
  const double along = (pq * pq + rp * rp - qr * qr) / (2.0 * pq);
  const double up = std::sqrt(std::fmax(rp * rp - along * along, 0.0));
  const Vec2 x = (q - p) / pq;
  return p + along * x + up * perpendicular(x);
}

void place(const Surface& s, Nets& nets, CornerId c, Vec2 p, Vec2 q) {
  const CornerId n = mesh::next(c);
  const CornerId l = mesh::previous(c);
  auto& flat = nets.flat[mesh::face_of(c)];
  flat[c.value() % 3] = p;
  flat[n.value() % 3] = q;
  flat[l.value() % 3] = apex(p, q, s.length(s.edge(c)), s.length(s.edge(n)), s.length(s.edge(l)));
}

void lay_piece(const Surface& s, Nets& nets, FaceId root) {
  const PieceId id = nets.pieces.push_back({});
  unfold::Piece& piece = nets.pieces[id];
  piece.name = "P" + std::to_string(id.value());
  piece.parts = {PartId(0)};
  const CornerId c0 = mesh::corner(root, 0);
  place(s, nets, c0, {0.0, 0.0}, {s.length(s.edge(c0)), 0.0});
  nets.piece[root] = id;
  std::deque<FaceId> open{root};
  while (!open.empty()) {
    const FaceId f = open.front();
    open.pop_front();
    piece.faces.push_back(f);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(f, k);
      if (nets.use[s.edge(c)] != EdgeUse::fold || nets.piece[s.neighbor(c)].valid()) {
        continue;
      }
      place(s, nets, s.twin(c), nets.flat[f][(k + 1) % 3], nets.flat[f][k]);
      nets.piece[s.neighbor(c)] = id;
      open.push_back(s.neighbor(c));
    }
  }
  std::sort(piece.faces.begin(), piece.faces.end());
}

}  // namespace

FoldOrder breadth_first(const Surface& s) {
  FoldOrder order;
  std::vector<bool> seen(s.face_count(), false);
  for (const FaceId root : ids<FaceId>(s.face_count())) {
    if (seen[root.value()]) {
      continue;
    }
    seen[root.value()] = true;
    std::deque<FaceId> open{root};
    while (!open.empty()) {
      const FaceId f = open.front();
      open.pop_front();
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = s.neighbor(mesh::corner(f, k));
        if (g.valid() && !seen[g.value()]) {
          seen[g.value()] = true;
          order.push_back(s.edge(mesh::corner(f, k)));
          open.push_back(g);
        }
      }
    }
  }
  return order;
}

FoldOrder random_order(const Surface& s, std::uint64_t seed) {
  FoldOrder order;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    order.push_back(e);
  }
  Random random(seed);
  shuffle(order, random);
  return order;
}

FoldOrder steepest_edge(const Surface& s, std::uint64_t seed) {
  Random random(seed);
  const double z = 2.0 * random.unit() - 1.0;
  const double a = 2.0 * std::numbers::pi * random.unit();
  const double r = std::sqrt(1.0 - z * z);
  const Vec3 up{r * std::cos(a), r * std::sin(a), z};
  std::vector<double> best(s.vertex_count(), 1e-9);
  std::vector<EdgeId> cut(s.vertex_count());
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    for (const CornerId c : s.sides(e)) {
      if (!c.valid()) {
        continue;
      }
      for (const auto& [from, to] : {std::pair{s.vertex(c), s.vertex(mesh::next(c))},
                                     std::pair{s.vertex(mesh::next(c)), s.vertex(c)}}) {
        const double climb = dot(normalized(s.point(to) - s.point(from)), up);
        if (climb > best[from.value()]) {
          best[from.value()] = climb;
          cut[from.value()] = e;
        }
      }
    }
  }
  FoldOrder order;
  FoldOrder last;
  std::vector<bool> is_cut(s.edge_count(), false);
  for (const EdgeId e : cut) {
    if (e.valid()) {
      is_cut[e.value()] = true;
    }
  }
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    (is_cut[e.value()] ? last : order).push_back(e);
  }
  order.insert(order.end(), last.begin(), last.end());
  return order;
}

Nets lay_out(const Surface& s, const FoldOrder& order, const std::vector<EdgeId>& keep_cut) {
  Nets nets;
  nets.use = IdVector<EdgeId, EdgeUse>(s.edge_count(), EdgeUse::cut);
  nets.piece = IdVector<FaceId, PieceId>(s.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(s.face_count());
  DisjointSets sets(s.face_count());
  for (const EdgeId e : order) {
    const auto [a, b] = s.sides(e);
    if (b.valid() && std::find(keep_cut.begin(), keep_cut.end(), e) == keep_cut.end() &&
        sets.join(mesh::face_of(a).value(), mesh::face_of(b).value())) {
      nets.use[e] = EdgeUse::fold;
    }
  }
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    if (s.is_border(e)) {
      nets.use[e] = EdgeUse::border;
    }
  }
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    if (!nets.piece[f].valid()) {
      lay_piece(s, nets, f);
    }
  }
  unfold::number_joins(s, nets);
  return nets;
}

Surface random_hull(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 2.0 * random.unit() - 1.0;
    const double a = 2.0 * std::numbers::pi * random.unit();
    const double r = std::sqrt(1.0 - z * z);
    points.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        for (const auto& [b, c] : {std::pair{j, k}, std::pair{k, j}}) {
          const Vec3 normal = cross(points[b] - points[i], points[c] - points[i]);
          bool outermost = true;
          for (std::size_t m = 0; m < n && outermost; ++m) {
            outermost = m == i || m == j || m == k || dot(normal, points[m] - points[i]) < 0.0;
          }
          if (outermost) {
            faces.push_back({VertexId(i), VertexId(b), VertexId(c)});
          }
        }
      }
    }
  }
  return Surface(std::move(points), std::move(faces));
}

Surface flat_grid(int k) {
  std::vector<Vec3> points;
  for (int y = 0; y <= k; ++y) {
    for (int x = 0; x <= k; ++x) {
      points.push_back({static_cast<double>(x), static_cast<double>(y), 0.0});
    }
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (int y = 0; y < k; ++y) {
    for (int x = 0; x < k; ++x) {
      const VertexId a(y * (k + 1) + x);
      const VertexId b(y * (k + 1) + x + 1);
      const VertexId c((y + 1) * (k + 1) + x + 1);
      const VertexId d((y + 1) * (k + 1) + x);
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  }
  return Surface(std::move(points), std::move(faces));
}

EdgeId edge_between(const Surface& s, VertexId a, VertexId b) {
  for (const CornerId c : s.corners_at(a)) {
    if (s.vertex(mesh::next(c)) == b) {
      return s.edge(c);
    }
    if (s.vertex(mesh::previous(c)) == b) {
      return s.edge(mesh::previous(c));
    }
  }
  return {};
}

double penetration(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double best = -INFINITY;
  for (const auto& [p, q] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    for (std::size_t i = 0; i < p->size(); ++i) {
      const Vec2 at = (*p)[i];
      const Vec2 along = (*p)[(i + 1) % p->size()] - at;
      const Vec2 outward = -perpendicular(along) / length(along);
      double nearest = INFINITY;
      for (const Vec2 other : *q) {
        nearest = std::fmin(nearest, dot(outward, other - at));
      }
      best = std::fmax(best, nearest);
    }
  }
  return -best;
}

bool faces_overlap(const Nets& nets) {
  for (const unfold::Piece& piece : nets.pieces) {
    for (std::size_t i = 0; i < piece.faces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto& a = nets.flat[piece.faces[i]];
        const auto& b = nets.flat[piece.faces[j]];
        if (penetration({a.begin(), a.end()}, {b.begin(), b.end()}) > 1e-3) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace ridgecraft::test
