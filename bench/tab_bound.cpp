// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/tab_bound.hpp"

#include <algorithm>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::bench {

namespace {

struct Edge {
  EdgeId id;
  std::uint32_t a = 0;  // panels
  std::uint32_t b = 0;
  bool able = false;
  bool is_long = false;
};

/// Width of the flat region of c's face at usable_height_mm above c's edge, all of it on that line added up.
double width_behind(const mesh::Surface& surface, const prepare::Panels& panels, CornerId c) {
  const FaceId g = mesh::face_of(c);
  const Vec3 origin = surface.point(surface.vertex(c));
  const Vec3 along = normalized(surface.point(surface.vertex(mesh::next(c))) - origin);
  const Vec3 inward = cross(surface.normal(g), along);
  double sum = 0.0;
  for (const FaceId f : panels.faces[panels.panel[g]]) {
    unfold::ConvexShape flat;
    for (const VertexId v : surface.vertices(f)) {
      flat.push_back({dot(surface.point(v) - origin, along), dot(surface.point(v) - origin, inward)});
    }
    sum += unfold::width_at(flat, unfold::usable_height_mm);
  }
  return sum;
}

std::vector<Edge> find_edges(const mesh::Surface& surface, const prepare::Panels& panels) {
  std::vector<Edge> edges;
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    const CornerId twin = surface.twin(c);
    if (!twin.valid() || twin < c) {
      continue;
    }
    Edge edge;
    edge.id = surface.edge(c);
    edge.a = panels.panel[mesh::face_of(c)].value();
    edge.b = panels.panel[mesh::face_of(twin)].value();
    if (edge.a == edge.b) {
      continue;
    }
    const double size = surface.length(edge.id);
    edge.is_long = size > long_edge_mm;
    edge.able =
        width_behind(surface, panels, c) >= 0.5 * size || width_behind(surface, panels, twin) >= 0.5 * size;
    edges.push_back(edge);
  }
  return edges;
}

/// The cuts that are left by a spanning tree of folds taken in the order of `gain`, the smallest first: those
/// of greatest gain in sum. Returns that sum.
template <class Gain>
double most_gained(const std::vector<Edge>& edges, std::size_t panels, const Gain& gain) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    order.emplace_back(gain(edges[i]), i);
  }
  std::sort(order.begin(), order.end());
  DisjointSets sets(panels);
  double sum = 0.0;
  for (const auto& [value, i] : order) {
    sum += sets.join(edges[i].a, edges[i].b) ? 0.0 : value;
  }
  return sum;
}

}  // namespace

TabBound tab_bound(const mesh::Surface& surface, const prepare::Panels& panels) {
  const std::vector<Edge> edges = find_edges(surface, panels);
  TabBound bound;
  bound.able = IdVector<EdgeId, std::uint8_t>(surface.edge_count(), 0);
  for (const Edge& edge : edges) {
    bound.able[edge.id] = edge.able ? 1 : 0;
  }
  const auto able = std::count_if(edges.begin(), edges.end(), [](const Edge& e) { return e.able; });
  bound.edges = static_cast<double>(able) / static_cast<double>(std::max<std::size_t>(edges.size(), 1));
  const double cuts = most_gained(edges, panels.count(), [](const Edge&) { return 1.0; });
  const double best = most_gained(edges, panels.count(), [](const Edge& e) { return e.able ? 1.0 : 0.0; });
  bound.cuts = cuts > 0.0 ? best / cuts : 1.0;
  // A share s of the long cuts can be had when some net has able - s * all >= 0 (Dinkelbach): bisection.
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-5) {
    const double share = 0.5 * (low + high);
    const double gained = most_gained(
        edges, panels.count(), [&](const Edge& e) { return e.is_long ? (e.able ? 1.0 : 0.0) - share : 0.0; });
    (gained > 1e-12 ? low : high) = share;
  }
  bound.long_cuts = low > 0.0 ? high : 1.0;
  return bound;
}

}  // namespace ridgecraft::bench
