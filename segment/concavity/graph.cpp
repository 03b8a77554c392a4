// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

struct Candidate {
  std::uint32_t from;
  std::uint32_t to;
  float length;  ///< negative: no such arc
};

/// The straight line between the corners opposite to side k of f and its neighbour g, if it crosses the open
/// side.
Candidate line_across(const ScaledSurface& s, std::uint32_t f, unsigned k, std::uint32_t g, double sagitta) {
  const std::uint32_t a = s.corners[f][k];
  const std::uint32_t b = s.corners[f][(k + 1) % 3];
  const std::uint32_t p = s.corners[f][(k + 2) % 3];
  const auto& c = s.corners[g];
  const std::uint32_t q = c[0] != a && c[0] != b ? c[0] : (c[1] != a && c[1] != b ? c[1] : c[2]);
  Candidate none_there{p, q, -1.0F};
  const Vec3 along = s.points[b] - s.points[a];
  const double size = length(along);
  if (p == q || !(size > 0.0)) {
    return none_there;
  }
  const Vec3 unit = along / size;
  const Vec3 to_p = s.points[p] - s.points[a];
  const Vec3 to_q = s.points[q] - s.points[a];
  const double tp = dot(to_p, unit);
  const double tq = dot(to_q, unit);
  const double hp = length(to_p - tp * unit);
  const double hq = length(to_q - tq * unit);
  const double rise = hp + hq;
  if (!(rise > 0.0)) {
    return none_there;
  }
  const double at = tp + (tq - tp) * (hp / rise);
  if (!(at > 0.0 && at < size)) {
    return none_there;
  }
  if (distance_to_segment(s.points[a] + at * unit, s.points[p], s.points[q]) > sagitta) {
    return none_there;
  }
  return {p, q, static_cast<float>(std::sqrt((tp - tq) * (tp - tq) + rise * rise))};
}

/// Calls visit(facet, side, neighbour) for each edge, from the smaller of its two facets; a border's
/// neighbour is none.
template <class Visit>
void for_edges(const ScaledSurface& s, const Visit& visit) {
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == no_index || g >= f) {
        visit(f, k, g);
      }
    }
  }
}

/// Makes room for the arcs of each vertex: those along edges, then those across.
struct ArcPlaces {
  explicit ArcPlaces(std::size_t vertices) : along(vertices, 0), across(vertices, 0) {}

  /// From counts to the places where the next arc of each vertex goes.
  void lay_out(VertexGraph& graph) {
    const std::size_t vertices = along.size();
    graph.first.resize(vertices + 1);
    graph.across.resize(vertices);
    std::uint32_t total = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
      graph.first[v] = total;
      total += std::exchange(along[v], total);
      graph.across[v] = total;
      total += std::exchange(across[v], total);
    }
    graph.first[vertices] = total;
    graph.arcs.resize(total);
    graph.side.resize(total);
  }

  std::vector<std::uint32_t> along;
  std::vector<std::uint32_t> across;
};

}  // namespace

VertexGraph build_vertex_graph(const ScaledSurface& s, double sagitta) {
  VertexGraph graph;
  ArcPlaces places(s.vertex_count());
  std::vector<Candidate> lines;
  lines.reserve(3 * s.facet_count() / 2 + 1);
  for_edges(s, [&](std::uint32_t f, unsigned k, std::uint32_t g) {
    ++places.along[s.corners[f][k]];
    ++places.along[s.corners[f][(k + 1) % 3]];
    if (g == no_index) {
      return;
    }
    lines.push_back(line_across(s, f, k, g, sagitta));
    if (lines.back().length >= 0.0F) {
      ++places.across[lines.back().from];
      ++places.across[lines.back().to];
    }
  });
  places.lay_out(graph);
  std::size_t line = 0;
  for_edges(s, [&](std::uint32_t f, unsigned k, std::uint32_t g) {
    const std::uint32_t a = s.corners[f][k];
    const std::uint32_t b = s.corners[f][(k + 1) % 3];
    const auto size = static_cast<float>(length(s.points[b] - s.points[a]));
    const std::uint32_t side = 3 * f + k;
    const auto add = [&](std::uint32_t at, std::uint32_t target, float arc_length) {
      graph.arcs[at] = {target, arc_length};
      graph.side[at] = side;
    };
    add(places.along[a]++, b, size);
    add(places.along[b]++, a, size);
    if (g == no_index) {
      return;
    }
    const Candidate& c = lines[line++];
    if (c.length >= 0.0F) {
      add(places.across[c.from]++, c.to, c.length);
      add(places.across[c.to]++, c.from, c.length);
    }
  });
  double sum = 0.0;
  for (const Arc& arc : graph.arcs) {
    sum += static_cast<double>(arc.length);
  }
  graph.mean_length = sum > 0.0 ? sum / static_cast<double>(graph.arcs.size()) : 1.0;
  return graph;
}

/// How far a jump may lean out of the surface at its ends, as the cosine to the normal there
/// (docs/design/segmentation.md, "Arcs and jumps").
constexpr double jump_lean = 0.3;

PartGraph::PartGraph(const ScaledSurface& surface, const VertexGraph& graph, bool jumps)
    : surface_(&surface),
      graph_(&graph),
      jumps_(jumps),
      member_(surface.facet_count(), 0),
      vertex_mark_(surface.vertex_count(), 0),
      partial_(surface.vertex_count(), 0),
      loop_mark_(surface.vertex_count(), 0),
      loop_(surface.vertex_count(), no_index) {}

void PartGraph::select(std::span<const std::uint32_t> facets) {
  ++current_;
  facets_.assign(facets.begin(), facets.end());
  vertices_.clear();
  for (const std::uint32_t f : facets_) {
    member_[f] = current_;
    for (const std::uint32_t v : surface_->corners[f]) {
      if (vertex_mark_[v] != current_) {
        vertex_mark_[v] = current_;
        vertices_.push_back(v);
      }
    }
  }
  find_loops();
}

/// Marks what lies at edges whose neighbour facet is in another part, and collects these edges where jumps
/// are allowed.
void PartGraph::find_cut_edges() {
  cut_edges_.clear();
  on_cut_.clear();
  for (const std::uint32_t f : facets_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = surface_->neighbors[f][k];
      if (g == no_index || member_[g] == current_) {
        continue;
      }
      const std::uint32_t a = surface_->corners[f][k];
      const std::uint32_t b = surface_->corners[f][(k + 1) % 3];
      // Their facets are incomplete; the third corner lacks its arc across this edge. All other vertices of
      // the part have all their facets, since a fan that is partly outside has a cut edge.
      partial_[a] = partial_[b] = partial_[surface_->corners[f][(k + 2) % 3]] = current_;
      if (!jumps_) {
        continue;
      }
      cut_edges_.push_back({a, b});
      for (const std::uint32_t v : {a, b}) {
        if (loop_mark_[v] != current_) {
          loop_mark_[v] = current_;
          on_cut_.push_back(v);
        }
      }
    }
  }
}

/// Cut edges that hang together over vertices are a loop; loops are numbered by their smallest vertex.
void PartGraph::find_loops() {
  find_cut_edges();
  loop_first_.assign(1, 0);
  loop_vertices_.clear();
  if (on_cut_.empty()) {
    return;
  }
  std::sort(on_cut_.begin(), on_cut_.end());
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(on_cut_.begin(), on_cut_.end(), v) - on_cut_.begin());
  };
  DisjointSets sets(on_cut_.size());
  for (const auto& [a, b] : cut_edges_) {
    sets.join(place(a), place(b));
  }
  // The first of each set stands for it, so it has its number before the others ask for it.
  std::vector<std::uint32_t> count;
  for (std::uint32_t i = 0; i < on_cut_.size(); ++i) {
    const std::uint32_t first = sets.find(i);
    if (first == i) {
      loop_[on_cut_[i]] = static_cast<std::uint32_t>(count.size());
      count.push_back(0);
    }
    loop_[on_cut_[i]] = loop_[on_cut_[first]];
    ++count[loop_[on_cut_[i]]];
  }
  for (const std::uint32_t c : count) {
    loop_first_.push_back(loop_first_.back() + c);
  }
  std::vector<std::uint32_t> fill(loop_first_.begin(), loop_first_.end() - 1);
  loop_vertices_.resize(on_cut_.size());
  for (const std::uint32_t v : on_cut_) {
    loop_vertices_[fill[loop_[v]]++] = v;
  }
}

bool PartGraph::arc_exists(std::uint32_t v, std::uint32_t i) const {
  return i < graph_->across[v] ? has_one_beside(i) : has_both_beside(i);
}

std::uint32_t PartGraph::find_arc(std::uint32_t from, std::uint32_t to) const {
  std::uint32_t best = no_index;
  for_arcs(from, [&](std::uint32_t i, const Arc& a) {
    if (a.target == to && (best == no_index || a.length < graph_->arcs[best].length)) {
      best = i;
    }
  });
  return best;
}

bool PartGraph::starts_inside(std::uint32_t p, std::uint32_t q, double distance) const {
  const Vec3 way = surface_->points[q] - surface_->points[p];
  const double limit = jump_lean * distance;
  return dot(surface_->vertex_normals[p], way) <= limit && -dot(surface_->vertex_normals[q], way) <= limit;
}

bool PartGraph::jump_exists(std::uint32_t p, std::uint32_t q) const {
  const std::uint32_t at = loop_at(p);
  if (at == no_index || loop_at(q) != at || p == q) {
    return false;
  }
  return starts_inside(p, q, length(surface_->points[q] - surface_->points[p]));
}

}  // namespace ridgecraft::segment
