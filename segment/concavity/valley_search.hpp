// SPDX-License-Identifier: GPL-3.0-or-later
// Valleys as shortest paths on a part (docs/design/segmentation.md, "Arcs and jumps"): the search, its queue,
// and the valleys found earlier in the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/no_index.hpp"
#include "segment/concavity/graph.hpp"

namespace ridgecraft::segment {

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
