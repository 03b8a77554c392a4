// SPDX-License-Identifier: GPL-3.0-or-later
// Shortest paths on a part: valleys between two vertices (docs/design/segmentation.md, "Arcs and jumps") and
// distances from several.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/concavity/bucket_queue.hpp"
#include "segment/concavity/part_graph.hpp"

namespace ridgecraft::segment {

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
    std::uint32_t from = none;
    std::uint32_t arc = none;
    std::uint32_t goal = none;  ///< number of the goal that the estimate is for
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
  std::uint32_t source_ = none;  ///< of the last find(); none after a flood
  std::uint32_t selection_ = 0;  ///< part that it was on
  /// Vertices that the last find() reached, but from which it didn't take all arcs.
  std::vector<BucketQueue::Entry> left_;
  std::vector<std::uint32_t> unfinished_;
};

}  // namespace ridgecraft::segment
