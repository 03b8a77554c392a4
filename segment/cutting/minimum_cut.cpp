// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/minimum_cut.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

constexpr std::uint32_t unreachable = 0xffffffffU;
constexpr std::uint8_t unpaired = 3;

/// Nodes of a cluster at most. Larger ones make the flow cheaper and the band wider.
constexpr std::size_t cluster_size = 32;
/// Clusters on each side of the cut that stay open, counted in steps. With a band of two steps the cheapest
/// cut of a sphere with six spikes often lies outside: one spike gets twice the facets that belong to it, and
/// another one is cut in two.
constexpr int band_steps = 6;

/// What borders between clusters count for: a smooth border of length 1 is about 4 / pi long on a square grid
/// of cells, in the mean over all directions.
constexpr std::int64_t border_numerator = 3;
constexpr std::int64_t border_denominator = 4;

std::int64_t saturated_sum(std::int64_t a, std::int64_t b) {
  return std::min(a + b, MaximumFlow::infinite_capacity);
}

}  // namespace

void MaximumFlow::reset(std::uint32_t n) {
  nodes_.assign(n, Node{});
  for (Node& node : nodes_) {
    node.back = {unpaired, unpaired, unpaired};
  }
}

void MaximumFlow::set_arc(std::uint32_t node, unsigned k, std::uint32_t other, std::int64_t capacity) {
  nodes_[node].other[k] = other;
  nodes_[node].residual[k] = capacity;
}

void MaximumFlow::add_source(std::uint32_t node, std::int64_t capacity) {
  nodes_[node].terminal_residual += capacity;
}

void MaximumFlow::add_sink(std::uint32_t node, std::int64_t capacity) {
  nodes_[node].terminal_residual -= capacity;
}

void MaximumFlow::pair_slots() {
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t j = nodes_[i].other[k];
      if (j == no_index || nodes_[i].back[k] != unpaired) {
        continue;
      }
      for (std::uint8_t l = 0; l < 3; ++l) {
        if (nodes_[j].other[l] == i && nodes_[j].back[l] == unpaired && (i != j || l != k)) {
          nodes_[i].back[k] = l;
          nodes_[j].back[l] = k;
          break;
        }
      }
      RIDGECRAFT_ASSERT(nodes_[i].back[k] != unpaired);
    }
  }
}

void MaximumFlow::activate(std::uint32_t node) {
  if (!nodes_[node].active) {
    nodes_[node].active = true;
    queue_.push_back(node);
  }
}

void MaximumFlow::start_trees() {
  queue_.clear();
  queue_head_ = 0;
  orphans_.clear();
  time_ = 0;
  flow_ = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    if (node.terminal_residual != 0) {
      node.tree = node.terminal_residual > 0 ? Tree::source : Tree::sink;
      node.parent = terminal;
      node.distance = 1;
      activate(i);
    }
  }
}

std::int64_t MaximumFlow::run() {
  pair_slots();
  start_trees();
  std::uint32_t current = no_index;
  for (;;) {
    if (current == no_index || nodes_[current].tree == Tree::free) {
      current = no_index;
      while (queue_head_ < queue_.size() && current == no_index) {
        const std::uint32_t candidate = queue_[queue_head_++];
        nodes_[candidate].active = false;
        current = nodes_[candidate].tree == Tree::free ? no_index : candidate;
      }
      if (current == no_index) {
        return flow_;
      }
    }
    if (grow(current)) {
      ++time_;
      augment();
      adopt_orphans();
    } else {
      current = no_index;
    }
  }
}

std::int64_t MaximumFlow::towards(std::uint32_t node, unsigned k, Tree tree) const {
  const Node& n = nodes_[node];
  return tree == Tree::source ? nodes_[n.other[k]].residual[n.back[k]] : n.residual[k];
}

bool MaximumFlow::grow(std::uint32_t i) {
  Node& node = nodes_[i];
  for (unsigned k = 0; k < 3; ++k) {
    const std::uint32_t j = node.other[k];
    if (j == no_index) {
      continue;
    }
    Node& next = nodes_[j];
    const std::int64_t room = node.tree == Tree::source ? node.residual[k] : next.residual[node.back[k]];
    if (room <= 0) {
      continue;
    }
    if (next.tree == Tree::free) {
      next.tree = node.tree;
      next.parent = node.back[k];
      next.time = node.time;
      next.distance = node.distance + 1;
      activate(j);
    } else if (next.tree != node.tree) {
      meeting_node_ = node.tree == Tree::source ? i : j;
      meeting_slot_ = node.tree == Tree::source ? k : node.back[k];
      return true;
    } else if (next.time <= node.time && next.distance > node.distance + 1) {
      // A shorter way to the terminal.
      next.parent = node.back[k];
      next.time = node.time;
      next.distance = node.distance + 1;
    }
  }
  return false;
}

std::int64_t MaximumFlow::bottleneck() const {
  std::int64_t least = nodes_[meeting_node_].residual[meeting_slot_];
  for (const std::uint32_t start : {meeting_node_, nodes_[meeting_node_].other[meeting_slot_]}) {
    std::uint32_t i = start;
    while (nodes_[i].parent != terminal) {
      least = std::min(least, towards(i, nodes_[i].parent, nodes_[i].tree));
      i = nodes_[i].other[nodes_[i].parent];
    }
    const std::int64_t at_terminal = nodes_[i].terminal_residual;
    least = std::min(least, at_terminal > 0 ? at_terminal : -at_terminal);
  }
  return least;
}

void MaximumFlow::push_flow(std::int64_t amount) {
  const std::uint32_t across = nodes_[meeting_node_].other[meeting_slot_];
  nodes_[meeting_node_].residual[meeting_slot_] -= amount;
  nodes_[across].residual[nodes_[meeting_node_].back[meeting_slot_]] += amount;
  for (const std::uint32_t start : {meeting_node_, across}) {
    std::uint32_t i = start;
    while (nodes_[i].parent != terminal) {
      const unsigned k = nodes_[i].parent;
      const std::uint32_t up = nodes_[i].other[k];
      std::int64_t& from_node = nodes_[i].residual[k];
      std::int64_t& to_node = nodes_[up].residual[nodes_[i].back[k]];
      std::int64_t& used = nodes_[i].tree == Tree::source ? to_node : from_node;
      (nodes_[i].tree == Tree::source ? from_node : to_node) += amount;
      used -= amount;
      if (used == 0) {
        make_orphan(i);
      }
      i = up;
    }
    nodes_[i].terminal_residual += nodes_[i].tree == Tree::source ? -amount : amount;
    if (nodes_[i].terminal_residual == 0) {
      make_orphan(i);
    }
  }
}

void MaximumFlow::augment() {
  const std::int64_t amount = bottleneck();
  flow_ += amount;
  push_flow(amount);
}

void MaximumFlow::make_orphan(std::uint32_t node) {
  orphans_.push_back(node);
}

void MaximumFlow::adopt_orphans() {
  // Parents first become none for all, so that no orphan is adopted through another one.
  for (const std::uint32_t i : orphans_) {
    nodes_[i].parent = no_parent;
  }
  for (std::size_t head = 0; head < orphans_.size(); ++head) {
    adopt(orphans_[head]);
  }
  orphans_.clear();
}

std::uint32_t MaximumFlow::distance_to_terminal(std::uint32_t node) {
  std::uint32_t steps = 0;
  std::uint32_t i = node;
  for (;;) {
    Node& n = nodes_[i];
    if (n.time == time_ && n.parent != no_parent) {
      steps += n.distance;
      break;
    }
    if (n.parent == no_parent) {
      return unreachable;
    }
    ++steps;
    if (n.parent == terminal) {
      n.time = time_;
      n.distance = 1;
      break;
    }
    i = n.other[n.parent];
  }
  // Stamp the way so that later orphans of this round walk it once only.
  std::uint32_t left = steps;
  for (std::uint32_t j = node; nodes_[j].time != time_; j = nodes_[j].other[nodes_[j].parent]) {
    nodes_[j].time = time_;
    nodes_[j].distance = left--;
  }
  return steps;
}

void MaximumFlow::adopt(std::uint32_t i) {
  Node& node = nodes_[i];
  std::uint32_t best = unreachable;
  std::uint8_t parent = no_parent;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const std::uint32_t j = node.other[k];
    if (j == no_index || nodes_[j].tree != node.tree || nodes_[j].parent == no_parent ||
        towards(i, k, node.tree) <= 0) {
      continue;
    }
    const std::uint32_t distance = distance_to_terminal(j);
    if (distance != unreachable && distance < best) {
      best = distance;
      parent = k;
    }
  }
  if (best != unreachable) {
    node.parent = parent;
    node.time = time_;
    node.distance = best + 1;
    return;
  }
  for (std::uint8_t k = 0; k < 3; ++k) {
    const std::uint32_t j = node.other[k];
    if (j == no_index || nodes_[j].tree != node.tree) {
      continue;
    }
    if (towards(i, k, node.tree) > 0) {
      activate(j);
    }
    const std::uint8_t p = nodes_[j].parent;
    if (p != terminal && p != no_parent && nodes_[j].other[p] == i && nodes_[j].back[p] == k) {
      nodes_[j].parent = no_parent;
      orphans_.push_back(j);
    }
  }
  node.tree = Tree::free;
  node.active = false;  // its place in the queue is skipped, or used again when it is activated anew
}

void CoarseCut::run(const CutGraph& graph, std::vector<CutSide>& side) {
  join_nodes(graph);
  find_borders(graph);
  build_flow();
  flow_.run();
  open_band();
  held_.resize(clusters_);
  for (std::uint32_t c = 0; c < clusters_; ++c) {
    held_[c] = flow_.on_source_side(node_first_[c]) ? CutSide::source : CutSide::sink;
  }
  fill(side);
}

void CoarseCut::fill(std::vector<CutSide>& side) const {
  side.resize(cluster_.size());
  for (std::size_t i = 0; i < side.size(); ++i) {
    side[i] = open_[cluster_[i]] != 0 ? CutSide::open : held_[cluster_[i]];
  }
}

bool CoarseCut::widen(std::span<const std::uint32_t> nodes, std::vector<CutSide>& side) {
  queue_.clear();
  for (const std::uint32_t i : nodes) {
    open(cluster_[i]);
  }
  if (queue_.empty()) {
    return false;
  }
  steps_ *= 2;
  open_around();
  fill(side);
  return true;
}

/// Grows clusters breadth first, one after the other. A cluster begins where the one before met its limit, so
/// that few crumbs are left between them.
void CoarseCut::join_nodes(const CutGraph& graph) {
  cluster_.assign(graph.size(), no_index);
  clusters_ = 0;
  std::vector<std::uint32_t> starts;
  std::vector<CutGraph::Node> members;  // as in queue_
  const auto take = [&](std::uint32_t node) {
    cluster_[node] = clusters_;
    queue_.push_back(node);
    members.push_back(graph.node(node));
  };
  for (std::uint32_t start = 0; start < cluster_.size(); ++start) {
    starts.assign(1, start);
    for (std::size_t s = 0; s < starts.size(); ++s) {
      if (cluster_[starts[s]] != no_index) {
        continue;
      }
      queue_.clear();
      members.clear();
      take(starts[s]);
      // What can't be cut comes in whole, before a way out of it is taken.
      std::size_t closed = 0;
      for (std::size_t i = 0; i < queue_.size(); ++i) {
        for (; closed < queue_.size(); ++closed) {
          const std::array<CutGraph::Side, 3> sides = members[closed].sides;
          for (const CutGraph::Side& side : sides) {
            if (side.capacity >= MaximumFlow::infinite_capacity && cluster_[side.other] == no_index) {
              take(side.other);
            }
          }
        }
        const std::array<CutGraph::Side, 3> sides = members[i].sides;
        for (const CutGraph::Side& side : sides) {
          if (side.other == no_index || cluster_[side.other] != no_index) {
            continue;
          }
          if (side.crease || queue_.size() >= cluster_size) {
            starts.push_back(side.other);
          } else {
            take(side.other);
          }
        }
      }
      ++clusters_;
    }
  }
}

void CoarseCut::find_borders(const CutGraph& graph) {
  borders_.clear();
  source_.assign(clusters_, 0);
  sink_.assign(clusters_, 0);
  for (std::uint32_t i = 0; i < cluster_.size(); ++i) {
    const std::uint32_t c = cluster_[i];
    const CutGraph::Node node = graph.node(i);
    source_[c] = saturated_sum(source_[c], node.source);
    sink_[c] = saturated_sum(sink_[c], node.sink);
    for (const CutGraph::Side& side : node.sides) {
      if (side.other != no_index && cluster_[side.other] > c) {
        borders_.push_back({std::uint64_t{c} << 32U | cluster_[side.other], side.capacity});
      }
    }
  }
  std::sort(borders_.begin(), borders_.end(),
            [](const Border& a, const Border& b) { return a.pair < b.pair; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < borders_.size(); ++i) {
    if (kept > 0 && borders_[kept - 1].pair == borders_[i].pair) {
      borders_[kept - 1].capacity = saturated_sum(borders_[kept - 1].capacity, borders_[i].capacity);
    } else {
      borders_[kept++] = borders_[i];
    }
  }
  borders_.resize(kept);
  first_.assign(std::size_t{clusters_} + 1, 0);
  const auto low = [](const Border& b) { return static_cast<std::uint32_t>(b.pair >> 32U); };
  const auto high = [](const Border& b) { return static_cast<std::uint32_t>(b.pair & 0xffffffffU); };
  for (const Border& b : borders_) {
    ++first_[low(b) + 1];
    ++first_[high(b) + 1];
  }
  for (std::uint32_t c = 0; c < clusters_; ++c) {
    first_[c + 1] += first_[c];
  }
  neighbors_.resize(2 * kept);
  capacities_.resize(2 * kept);
  std::vector<std::uint32_t> fill(first_.begin(), first_.end() - 1);
  for (const Border& b : borders_) {
    for (const auto& [from, to] : {std::pair{low(b), high(b)}, std::pair{high(b), low(b)}}) {
      neighbors_[fill[from]] = to;
      capacities_[fill[from]++] = b.capacity;
    }
  }
}

/// Flow nodes have three arcs: a cluster with more neighbours is a chain of nodes that nothing can cut.
void CoarseCut::build_flow() {
  node_first_.resize(std::size_t{clusters_} + 1);
  node_first_[0] = 0;
  for (std::uint32_t c = 0; c < clusters_; ++c) {
    const auto degree = static_cast<std::uint32_t>(neighbors(c).size());
    node_first_[c + 1] = node_first_[c] + (degree > 3 ? degree - 2 : 1);
  }
  flow_.reset(node_first_[clusters_]);
  // Neighbour number n of a cluster hangs on its chain at node n - 1, the first and the last at the ends.
  const auto node_of = [&](std::uint32_t c, std::size_t n) {
    const std::size_t nodes = node_first_[c + 1] - node_first_[c];
    return node_first_[c] + static_cast<std::uint32_t>(n == 0 ? 0 : std::min(n - 1, nodes - 1));
  };
  std::vector<std::uint8_t> used(node_first_[clusters_], 0);
  const auto attach = [&](std::uint32_t node, std::uint32_t other, std::int64_t capacity) {
    flow_.set_arc(node, used[node]++, other, capacity);
  };
  for (std::uint32_t c = 0; c < clusters_; ++c) {
    for (std::uint32_t node = node_first_[c]; node + 1 < node_first_[c + 1]; ++node) {
      attach(node, node + 1, MaximumFlow::infinite_capacity);
      attach(node + 1, node, MaximumFlow::infinite_capacity);
    }
    flow_.add_source(node_first_[c], source_[c]);
    flow_.add_sink(node_first_[c], sink_[c]);
    const auto around = neighbors(c);
    for (std::size_t n = 0; n < around.size(); ++n) {
      const std::uint32_t d = around[n];
      const auto back = neighbors(d);
      // Neighbours ascend, since borders were sorted.
      const auto m = static_cast<std::size_t>(std::lower_bound(back.begin(), back.end(), c) - back.begin());
      const std::int64_t capacity = capacities_[first_[c] + n];
      attach(node_of(c, n), node_of(d, m),
             capacity < MaximumFlow::infinite_capacity ? capacity * border_numerator / border_denominator
                                                       : capacity);
    }
  }
}

void CoarseCut::open(std::uint32_t cluster) {
  if (open_[cluster] == 0) {
    open_[cluster] = 1;
    queue_.push_back(cluster);
  }
}

void CoarseCut::open_band() {
  const auto on_source = [&](std::uint32_t c) { return flow_.on_source_side(node_first_[c]); };
  open_.assign(clusters_, 0);
  queue_.clear();
  steps_ = band_steps;
  for (std::uint32_t c = 0; c < clusters_; ++c) {
    const auto around = neighbors(c);
    // The cut may also run between a cluster and the regions that are source and sink.
    if ((on_source(c) ? sink_[c] : source_[c]) > 0 ||
        std::any_of(around.begin(), around.end(),
                    [&](std::uint32_t d) { return on_source(d) != on_source(c); })) {
      open(c);
    }
  }
  open_around();
}

/// Opens what is at most steps_ from the clusters of the queue.
void CoarseCut::open_around() {
  std::size_t done = 0;
  for (int step = 0; step < steps_; ++step) {
    for (const std::size_t end = queue_.size(); done < end; ++done) {
      for (const std::uint32_t d : neighbors(queue_[done])) {
        open(d);
      }
    }
  }
}

}  // namespace ridgecraft::segment
