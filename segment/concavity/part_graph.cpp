// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/part_graph.hpp"

#include <algorithm>

namespace ridgecraft::segment {
namespace {

/// How far a jump may lean out of the surface at its ends, as the cosine to the normal there
/// (specification 3.2).
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

std::uint32_t PartGraph::root(std::uint32_t v) {
  while (loop_[v] != v) {
    loop_[v] = loop_[loop_[v]];
    v = loop_[v];
  }
  return v;
}

void PartGraph::find_loops() {
  on_cut_.clear();
  const auto touch = [&](std::uint32_t v) {
    if (loop_mark_[v] != current_) {
      loop_mark_[v] = current_;
      loop_[v] = v;
      on_cut_.push_back(v);
    }
  };
  for (const std::uint32_t f : facets_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = surface_->neighbors[f][k];
      if (g == none || member_[g] == current_) {
        continue;
      }
      const std::uint32_t a = surface_->corners[f][k];
      const std::uint32_t b = surface_->corners[f][(k + 1) % 3];
      touch(a);
      touch(b);
      // Their facets are incomplete; the third corner lacks its arc across this edge. All other vertices of
      // the part have all their facets, since a fan that is partly outside has a cut edge.
      partial_[a] = partial_[b] = partial_[surface_->corners[f][(k + 2) % 3]] = current_;
      const std::uint32_t x = root(a);
      const std::uint32_t y = root(b);
      loop_[std::max(x, y)] = std::min(x, y);
    }
  }
  if (!jumps_) {
    for (const std::uint32_t v : on_cut_) {
      loop_mark_[v] = 0;
    }
    on_cut_.clear();
  }
  // Roots are the smallest vertices of their loops, so sorting by (root, vertex) groups and orders
  // everything.
  std::sort(on_cut_.begin(), on_cut_.end());
  loop_first_.assign(1, 0);
  loop_vertices_.clear();
  if (on_cut_.empty()) {
    return;
  }
  std::vector<std::uint32_t> roots(on_cut_.size());
  std::vector<std::uint32_t> count;
  for (std::size_t i = 0; i < on_cut_.size(); ++i) {
    roots[i] = root(on_cut_[i]);
  }
  // Number the loops; a root comes before its members.
  std::vector<std::uint32_t> number(on_cut_.size());
  for (std::size_t i = 0; i < on_cut_.size(); ++i) {
    if (roots[i] == on_cut_[i]) {
      number[i] = static_cast<std::uint32_t>(count.size());
      count.push_back(0);
    } else {
      const auto at = std::lower_bound(on_cut_.begin(), on_cut_.end(), roots[i]) - on_cut_.begin();
      number[i] = number[static_cast<std::size_t>(at)];
    }
    ++count[number[i]];
  }
  for (const std::uint32_t c : count) {
    loop_first_.push_back(loop_first_.back() + c);
  }
  std::vector<std::uint32_t> fill(loop_first_.begin(), loop_first_.end() - 1);
  loop_vertices_.resize(on_cut_.size());
  for (std::size_t i = 0; i < on_cut_.size(); ++i) {
    loop_[on_cut_[i]] = number[i];
    loop_vertices_[fill[number[i]]++] = on_cut_[i];
  }
}

bool PartGraph::arc_exists(std::uint32_t v, std::uint32_t i) const {
  const Arc& a = graph_->arcs[i];
  return i < graph_->across[v] ? has(a.first_facet) || has(a.second_facet)
                               : has(a.first_facet) && has(a.second_facet);
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
