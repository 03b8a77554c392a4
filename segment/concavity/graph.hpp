// SPDX-License-Identifier: GPL-3.0-or-later
// The graph on which valleys run (docs/design/segmentation.md, "Arcs and jumps"): that of the whole surface,
// built once, and what of it belongs to the part under consideration.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/no_index.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// An arc from some vertex. Along an edge it exists in a part that has one of its facets, across an edge (the
/// straight line between the two opposite vertices, in the two triangles unfolded into one plane) in a part
/// that has both.
struct Arc {
  std::uint32_t target;
  float length;
};

struct VertexGraph {
  std::vector<Arc> arcs;  ///< of vertex v: arcs[first[v]] ... arcs[first[v + 1]], along edges first
  /// Of each arc the edge, as a side 3 f + k of one of its facets. Apart, since it is asked for at the
  /// borders of parts alone.
  std::vector<std::uint32_t> side;
  std::vector<std::uint32_t> first;   ///< one longer than there are vertices
  std::vector<std::uint32_t> across;  ///< of vertex v: its first arc across an edge
  double mean_length = 1.0;           ///< of an arc; 1 where all are points
};

/// Share of the tolerance that segmenting uses as `sagitta` below: far less than what counts as concave.
inline constexpr double arc_sagitta_share = 0.25;

/// `sagitta`: arcs across an edge that dip or rise by more than this from the straight line between their
/// ends are left out: a fold between two large triangles would otherwise be a bridge
/// of concavity 0 however deep it is. O(n).
[[nodiscard]] VertexGraph build_vertex_graph(const ScaledSurface& surface, double sagitta);

// The part under consideration: which facets, which arcs, where it was cut off and what may jump across
// (docs/design/segmentation.md, "Arcs and jumps").

/// A view of the vertex graph that shows one part at a time. Choosing a part costs O(its facets); nothing is
/// copied.
class PartGraph {
 public:
  /// Both must outlive this.
  /// `jumps`: whether cut loops are looked for, so that there is something to jump across.
  PartGraph(const ScaledSurface& surface, const VertexGraph& graph, bool jumps);

  /// Shows the part with these facets.
  void select(std::span<const std::uint32_t> facets);

  /// Another number for each part that was shown.
  [[nodiscard]] std::uint32_t selection() const { return current_; }
  [[nodiscard]] bool has(std::uint32_t facet) const {
    return facet != no_index && member_[facet] == current_;
  }
  [[nodiscard]] std::span<const std::uint32_t> facets() const { return facets_; }
  /// In order of first appearance.
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return vertices_; }

  /// Calls visit(arc number, Arc) for each arc of the part at v.
  template <class Visit>
  void for_arcs(std::uint32_t v, Visit&& visit) const {
    const std::uint32_t across = graph_->across[v];
    const std::uint32_t last = graph_->first[v + 1];
    if (partial_[v] != current_) {
      for (std::uint32_t i = graph_->first[v]; i < last; ++i) {
        visit(i, graph_->arcs[i]);
      }
      return;
    }
    for (std::uint32_t i = graph_->first[v]; i < across; ++i) {
      if (has_one_beside(i)) {
        visit(i, graph_->arcs[i]);
      }
    }
    for (std::uint32_t i = across; i < last; ++i) {
      if (has_both_beside(i)) {
        visit(i, graph_->arcs[i]);
      }
    }
  }
  /// The shortest arc of the part between two vertices; its number or none.
  [[nodiscard]] std::uint32_t find_arc(std::uint32_t from, std::uint32_t to) const;
  /// Whether arc number i, which starts at v, exists in this part.
  [[nodiscard]] bool arc_exists(std::uint32_t v, std::uint32_t i) const;
  [[nodiscard]] const Arc& arc(std::uint32_t i) const { return graph_->arcs[i]; }

  /// The cut loop at a vertex, or none; its vertices, ascending.
  [[nodiscard]] std::uint32_t loop_at(std::uint32_t v) const {
    return loop_mark_[v] == current_ ? loop_[v] : no_index;
  }
  [[nodiscard]] std::span<const std::uint32_t> loop(std::uint32_t index) const {
    return {loop_vertices_.data() + loop_first_[index], loop_first_[index + 1] - loop_first_[index]};
  }
  [[nodiscard]] bool has_loops() const { return loop_first_.size() > 1; }
  /// Whether the straight line from p to q starts into the solid at both ends; `distance` is its length,
  /// above 0.
  [[nodiscard]] bool starts_inside(std::uint32_t p, std::uint32_t q, double distance) const;
  /// Both on one cut loop and the jump is legal.
  [[nodiscard]] bool jump_exists(std::uint32_t p, std::uint32_t q) const;

  [[nodiscard]] const ScaledSurface& surface() const { return *surface_; }
  /// Of the whole surface; above 0.
  [[nodiscard]] double mean_arc_length() const { return graph_->mean_length; }

 private:
  /// The facets at the edge of arc number i.
  [[nodiscard]] bool has_one_beside(std::uint32_t i) const {
    const std::uint32_t side = graph_->side[i];
    return has(side / 3) || has(surface_->neighbors[side / 3][side % 3]);
  }
  [[nodiscard]] bool has_both_beside(std::uint32_t i) const {
    const std::uint32_t side = graph_->side[i];
    return has(side / 3) && has(surface_->neighbors[side / 3][side % 3]);
  }

  void find_cut_edges();
  void find_loops();

  const ScaledSurface* surface_;
  const VertexGraph* graph_;
  bool jumps_;
  std::uint32_t current_ = 0;
  std::vector<std::uint32_t> member_;
  std::vector<std::uint32_t> facets_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> vertex_mark_;
  std::vector<std::uint32_t> partial_;  ///< vertices some of whose arcs are missing in this part
  std::vector<std::uint32_t> loop_mark_;
  std::vector<std::uint32_t> loop_;  ///< of each vertex that loop_mark_ says is on one: its number
  std::vector<std::uint32_t> loop_vertices_;
  std::vector<std::uint32_t> loop_first_;
  std::vector<std::array<std::uint32_t, 2>> cut_edges_;  ///< that may be jumped from
  std::vector<std::uint32_t> on_cut_;                    ///< their vertices, ascending
};

}  // namespace ridgecraft::segment
