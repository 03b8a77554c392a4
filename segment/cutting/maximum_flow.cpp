// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/maximum_flow.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace ridgecraft::segment {
namespace {

constexpr std::uint32_t unreachable = 0xffffffffU;
constexpr std::uint8_t unpaired = 3;

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
      if (j == no_node || nodes_[i].back[k] != unpaired) {
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
  std::uint32_t current = no_node;
  for (;;) {
    if (current == no_node || nodes_[current].tree == Tree::free) {
      current = no_node;
      while (queue_head_ < queue_.size() && current == no_node) {
        const std::uint32_t candidate = queue_[queue_head_++];
        nodes_[candidate].active = false;
        current = nodes_[candidate].tree == Tree::free ? no_node : candidate;
      }
      if (current == no_node) {
        return flow_;
      }
    }
    if (grow(current)) {
      ++time_;
      augment();
      adopt_orphans();
    } else {
      current = no_node;
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
    if (j == no_node) {
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
    if (j == no_node || nodes_[j].tree != node.tree || nodes_[j].parent == no_parent ||
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
    if (j == no_node || nodes_[j].tree != node.tree) {
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

}  // namespace ridgecraft::segment
