// SPDX-License-Identifier: GPL-3.0-or-later
// Minimum cuts through facets: maximum flow, and clusters of facets that tell where the cut surely isn't
// (docs/design/segmentation.md, "One part, cut").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/no_index.hpp"

namespace ridgecraft::segment {

// Maximum flow and smallest minimum cut on graphs whose nodes have at most three arcs, as facets have.

/// Y. Boykov, V. Kolmogorov, "An experimental comparison of min-cut/max-flow algorithms for energy
/// minimization in vision", PAMI 26 (2004): two search trees that are kept between augmentations. Arcs are
/// undirected: their capacity holds both ways. Integers, so that the cut doesn't depend on the order of the
/// augmentations. Why not Boost's: docs/design/segmentation.md, "What is written by hand, and why".
class MaximumFlow {
 public:
  /// More than any sum of real capacities; residuals of it stay below 2^63.
  static constexpr std::int64_t infinite_capacity = std::int64_t{1} << 61U;

  /// Starts a graph of n nodes without arcs.
  void reset(std::uint32_t n);
  /// Arc at slot k (0..2) of a node; the other end must get the same at one of its slots.
  void set_arc(std::uint32_t node, unsigned k, std::uint32_t other, std::int64_t capacity);
  void add_source(std::uint32_t node, std::int64_t capacity);
  void add_sink(std::uint32_t node, std::int64_t capacity);
  /// Returns the value of the flow.
  std::int64_t run();
  /// After run(): whether flow could still reach this node from the source. Those nodes are the smallest
  /// source side of all minimum cuts.
  [[nodiscard]] bool on_source_side(std::uint32_t node) const { return nodes_[node].tree == Tree::source; }

 private:
  enum class Tree : std::uint8_t { free, source, sink };
  static constexpr std::uint8_t terminal = 3;
  static constexpr std::uint8_t no_parent = 4;

  struct Node {
    std::array<std::int64_t, 3> residual{};  ///< of the arc that leaves at this slot
    std::int64_t terminal_residual = 0;      ///< above 0 from the source, below 0 to the sink
    std::array<std::uint32_t, 3> other{no_index, no_index, no_index};
    std::uint32_t distance = 0;  ///< to the terminal, as known at `time`
    std::uint32_t time = 0;
    std::array<std::uint8_t, 3> back{};  ///< slot of the same arc at its other end
    Tree tree = Tree::free;
    std::uint8_t parent = no_parent;  ///< slot towards the root, terminal or no_parent
    bool active = false;
  };

  void pair_slots();
  void start_trees();
  void activate(std::uint32_t node);
  bool grow(std::uint32_t node);
  void augment();
  [[nodiscard]] std::int64_t bottleneck() const;
  void push_flow(std::int64_t amount);
  void make_orphan(std::uint32_t node);
  void adopt_orphans();
  void adopt(std::uint32_t node);
  /// Residual in the direction from the root to the node over slot k of the node, for its tree.
  [[nodiscard]] std::int64_t towards(std::uint32_t node, unsigned k, Tree tree) const;
  std::uint32_t distance_to_terminal(std::uint32_t node);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> queue_;
  std::size_t queue_head_ = 0;
  std::vector<std::uint32_t> orphans_;
  std::uint32_t time_ = 0;
  std::int64_t flow_ = 0;
  std::uint32_t meeting_node_ =
      no_index;  ///< of the source tree, whose arc meeting_slot_ leads into the sink tree
  unsigned meeting_slot_ = 0;
};

/// A cut problem on nodes with at most three arcs, as MaximumFlow takes it. It is asked node by node: of
/// millions of nodes a list of the answers would take more memory than all else that cutting needs.
class CutGraph {
 public:
  struct Side {
    std::int64_t capacity = 0;
    std::uint32_t other = no_index;
    bool crease = false;  ///< a likely place for the cut
  };
  struct Node {
    std::array<Side, 3> sides;  ///< both ends of an arc have it, with the same capacity
    std::int64_t source = 0;    ///< capacity of its arc from the source
    std::int64_t sink = 0;
  };

  CutGraph() = default;
  virtual ~CutGraph() = default;
  CutGraph(const CutGraph&) = default;
  CutGraph& operator=(const CutGraph&) = default;

  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual Node node(std::uint32_t i) const = 0;
};

/// What is known of a node: on one side of the cut, or still open.
enum class CutSide : std::uint8_t { open, source, sink };

/// Joins the nodes to connected clusters that cross no crease, cuts between clusters and leaves open the
/// nodes of clusters near that cut. A minimum cut in which the others are held is one of the whole graph if
/// one of those runs within the open band; else a little dearer. O(n log n) and a maximum flow on a fifth of
/// the nodes.
class CoarseCut {
 public:
  /// Fills `side` for each node of the graph.
  void run(const CutGraph& graph, std::vector<CutSide>& side);
  /// Opens the clusters of these nodes, against which a cut in the band ran, and what is around them: twice
  /// as far as last time. False when all were open. Cuts found in ever wider bands never become dearer.
  bool widen(std::span<const std::uint32_t> nodes, std::vector<CutSide>& side);

 private:
  struct Border {
    std::uint64_t pair;  ///< smaller cluster, then larger
    std::int64_t capacity;
  };

  void join_nodes(const CutGraph& graph);
  void find_borders(const CutGraph& graph);
  void build_flow();
  void open(std::uint32_t cluster);
  void open_band();
  void open_around();
  void fill(std::vector<CutSide>& side) const;
  [[nodiscard]] std::span<const std::uint32_t> neighbors(std::uint32_t cluster) const {
    return {neighbors_.data() + first_[cluster], first_[cluster + 1] - first_[cluster]};
  }

  std::vector<std::uint32_t> cluster_;  ///< of each node
  std::uint32_t clusters_ = 0;
  std::vector<std::uint32_t> queue_;
  std::vector<Border> borders_;
  std::vector<std::uint32_t> first_;      ///< of each cluster, in neighbors_ and capacities_
  std::vector<std::uint32_t> neighbors_;  ///< clusters next to each cluster
  std::vector<std::int64_t> capacities_;
  std::vector<std::int64_t> source_;
  std::vector<std::int64_t> sink_;
  std::vector<std::uint8_t> open_;         ///< whether a cluster is near a cut
  std::vector<CutSide> held_;              ///< side of a cluster that isn't open
  int steps_ = 0;                          ///< how far is opened around what is to be open
  std::vector<std::uint32_t> node_first_;  ///< first flow node of each cluster
  MaximumFlow flow_;
};

}  // namespace ridgecraft::segment
