// SPDX-License-Identifier: GPL-3.0-or-later
// The graph on which valleys run, that of the whole surface and what of it belongs to the part under
// consideration, and shortest paths on it: the search, its queue, and the valleys found earlier in the run
// (docs/design/segmentation.md, "Arcs and jumps").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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

// The queue of shortest-path searches: vertices by key, nearly smallest first.

/// A priority queue that is as exact as its buckets are narrow: an entry taken may be behind others of its
/// bucket. Searches with it look at a vertex again when a shorter way to it turns up, so paths come out exact
/// all the same, and there is no heap to keep. Many entries of a search are never taken: they cost a
/// push_back.
class BucketQueue {
 public:
  struct Entry {
    float key;
    std::uint32_t vertex;
  };

  BucketQueue() : buckets_(1) {}
  /// Empties it for keys from `base` on, at least 0. `width` of a bucket: best such that few entries share
  /// one.
  void start(float base, float width);
  void push(float key, std::uint32_t v) {
    std::uint32_t bucket = bucket_of(key);
    bucket = bucket < current_ ? current_ : bucket;
    if (bucket >= buckets_.size()) {
      buckets_.resize(std::size_t{bucket} + 1);
    }
    last_ = bucket > last_ ? bucket : last_;
    buckets_[bucket].push_back({key, v});
  }
  /// Takes an entry of the first bucket that has one, the one that came last; false when there is none.
  [[nodiscard]] bool pop(Entry& entry);
  /// Takes all entries that are left, in order of their buckets. Their keys are past then, and it is empty.
  void drain(std::vector<Entry>& left);
  /// Whether all entries with keys up to this one have been taken.
  [[nodiscard]] bool is_past(float key) const { return bucket_of(key) < current_; }

 private:
  static constexpr std::uint32_t most_buckets = 4096;

  [[nodiscard]] std::uint32_t bucket_of(float key) const {
    const float place = (key - base_) * inverse_width_;
    return place < static_cast<float>(most_buckets - 1)
               ? static_cast<std::uint32_t>(place > 0.0F ? place : 0.0F)
               : most_buckets - 1;
  }

  float base_ = 0.0F;
  float inverse_width_ = 1.0F;
  std::uint32_t current_ = 0;  ///< bucket from which entries are taken
  std::uint32_t last_ = 0;     ///< last bucket in use
  std::vector<std::vector<Entry>> buckets_;
};

// Shortest paths on a part: valleys between two vertices (docs/design/segmentation.md, "Arcs and jumps") and
// distances from several.

/// Length of a path that doesn't exist.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Arc number of a step that is a jump across a cut loop.
inline constexpr std::uint32_t jump_arc = 0xfffffffeU;

/// One vertex of a valley and how it is reached from the vertex before.
struct Step {
  std::uint32_t vertex;
  std::uint32_t arc;  ///< arc number, jump_arc, or none at the first vertex
};

/// A vertex and the key it starts with.
struct Start {
  std::uint32_t vertex;
  double key;
};

/// Searches on whatever part the graph shows. Flat arrays that are never cleared: entries carry the search's
/// number.
class ValleySearch {
 public:
  explicit ValleySearch(const PartGraph& graph);

  /// A* from one vertex to another along arcs and jumps, with the straight distance as estimate. Equal
  /// lengths: over the vertex of least key, then the smaller one, whatever was searched before (of jumps, the
  /// one that was found first). Fills `path`
  /// from `from` to `to` and gives its length; infinite when there is none. From the same vertex as the last
  /// time, on the same part, it goes on with what is known: bridges of one vertex are searched in a row.
  double find(std::uint32_t from, std::uint32_t to, std::vector<Step>& path);

  /// Dijkstra along arcs without jumps from several starts, until keys reach `limit`. Fills `reached` with
  /// the vertices whose key is below it; their keys stay readable through key().
  void flood(std::span<const Start> starts, double limit, std::vector<std::uint32_t>& reached);
  /// Key of a vertex in the last search; infinite when it wasn't reached.
  [[nodiscard]] double key(std::uint32_t v) const {
    return nodes_[v].search == search_ ? nodes_[v].key : infinite;
  }

 private:
  struct Node {
    double key = 0.0;  ///< length of the path so far
    float estimate = 0.0F;
    std::uint32_t search = 0;
    std::uint32_t from = no_index;
    std::uint32_t arc = no_index;
    std::uint32_t goal = no_index;  ///< number of the goal that the estimate is for
  };

  [[nodiscard]] bool comes_first(std::uint32_t v, std::uint32_t other) const;
  void begin(std::uint32_t from);
  void go_on();
  void expand(std::uint32_t v, std::uint32_t to, float& bound);
  bool relax_jumps(std::uint32_t v, std::uint32_t to, float bound);
  [[nodiscard]] float estimate(std::uint32_t v, const Node& node) const;

  const PartGraph* graph_;
  std::vector<Node> nodes_;
  BucketQueue queue_;
  float bucket_width_ = 1.0F;
  std::uint32_t search_ = 0;
  std::uint32_t goal_ = 0;  ///< number of the goal, not a vertex
  Vec3 goal_point_;
  std::uint32_t source_ = no_index;  ///< of the last find(); none after a flood
  std::uint32_t selection_ = 0;      ///< part that it was on
  /// Vertices that the last find() reached, but from which it didn't take all arcs.
  std::vector<BucketQueue::Entry> left_;
  std::vector<std::uint32_t> unfinished_;
};

// Valleys found earlier in the run (docs/design/segmentation.md, "Known valleys"): parts of a part often have
// the same ones.

/// A valley with what doesn't depend on the part: its path, length and uncapped concavity.
struct Valley {
  std::span<const Step> steps;
  std::span<const double> concavity;  ///< of each step, without the cap
  double length = 0.0;
  double greatest = 0.0;   ///< of concavity
  std::uint64_t part = 0;  ///< signature of the part on which it was searched
};

/// Open addressing over flat pools. Spans are valid until the next store().
class ValleyCache {
 public:
  ValleyCache();
  /// Whether there is a valley between the two vertices; fills `out`.
  [[nodiscard]] bool find(std::uint32_t from, std::uint32_t to, Valley& out) const;
  /// Keeps a copy, in place of an earlier one between the same vertices.
  void store(std::uint32_t from, std::uint32_t to, const Valley& valley);
  /// Takes all valleys of another one over, in place of those between the same vertices.
  void absorb(const ValleyCache& other);

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::size_t first = 0;
    std::uint32_t count = 0;  ///< 0: free
    double length = 0.0;
    double greatest = 0.0;
    std::uint64_t part = 0;
  };

  [[nodiscard]] std::size_t slot(std::uint64_t key) const;
  void grow();

  std::vector<Entry> table_;
  std::size_t used_ = 0;
  std::vector<Step> steps_;
  std::vector<double> concavity_;
};

}  // namespace ridgecraft::segment
