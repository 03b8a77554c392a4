// SPDX-License-Identifier: GPL-3.0-or-later
// Where a minimum cut through many facets surely isn't: found on clusters of facets
// (docs/design/segmentation.md, "One part, cut").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/cutting/maximum_flow.hpp"

namespace ridgecraft::segment {

/// A cut problem on nodes with at most three arcs, as MaximumFlow takes it. It is asked node by node: of
/// millions of nodes a list of the answers would take more memory than all else that cutting needs.
class CutGraph {
 public:
  struct Side {
    std::int64_t capacity = 0;
    std::uint32_t other = MaximumFlow::no_node;
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
  std::vector<std::uint32_t> neighbors_;  ///< clusters beside each cluster
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
