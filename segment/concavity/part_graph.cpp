// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/part_graph.hpp"

#include <algorithm>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::segment {
namespace {

/// How far a jump may lean out of the surface at its ends, as the cosine to the normal there
/// (docs/design/segmentation.md, "Arcs and jumps").
constexpr double jump_lean = 0.3;

}  // namespace

PartGraph::PartGraph(const ScaledSurface& surface, const VertexGraph& graph, bool jumps)
    : surface_(&surface),
      graph_(&graph),
      jumps_(jumps),
      member_(surface.facet_count(), 0),
      vertex_mark_(surface.vertex_count(), 0),
      partial_(surface.vertex_count(), 0),
      loop_mark_(surface.vertex_count(), 0),
      loop_(surface.vertex_count(), none) {}

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
      if (g == none || member_[g] == current_) {
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
  std::uint32_t best = none;
  for_arcs(from, [&](std::uint32_t i, const Arc& a) {
    if (a.target == to && (best == none || a.length < graph_->arcs[best].length)) {
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
  if (at == none || loop_at(q) != at || p == q) {
    return false;
  }
  return starts_inside(p, q, length(surface_->points[q] - surface_->points[p]));
}

}  // namespace ridgecraft::segment
