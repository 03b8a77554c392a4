// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/valley_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ridgecraft::segment {
namespace {

/// Floats that aren't negative are ordered as their bits are.
std::uint64_t heap_entry(float key, std::uint32_t v) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(key)} << 32U | v;
}

}  // namespace

ValleySearch::ValleySearch(const PartGraph& graph) : graph_(&graph), nodes_(graph.surface().vertex_count()) {}

void ValleySearch::push(float key, std::uint32_t v) {
  const std::uint64_t entry = heap_entry(key, v);
  std::size_t i = heap_.size();
  heap_.push_back(entry);
  while (i > 0) {
    const std::size_t up = (i - 1) / 4;
    if (heap_[up] <= entry) {
      break;
    }
    heap_[i] = heap_[up];
    i = up;
  }
  heap_[i] = entry;
}

std::uint64_t ValleySearch::pop() {
  const std::uint64_t top = heap_.front();
  const std::uint64_t last = heap_.back();
  heap_.pop_back();
  const std::size_t n = heap_.size();
  if (n == 0) {
    return top;
  }
  std::size_t i = 0;
  for (;;) {
    const std::size_t child = 4 * i + 1;
    if (child >= n) {
      break;
    }
    std::size_t least = child;
    const std::size_t end = std::min(child + 4, n);
    for (std::size_t c = child + 1; c < end; ++c) {
      least = heap_[c] < heap_[least] ? c : least;
    }
    if (heap_[least] >= last) {
      break;
    }
    heap_[i] = heap_[least];
    i = least;
  }
  heap_[i] = last;
  return top;
}

void ValleySearch::relax_jumps(std::uint32_t v, std::uint32_t target) {
  const std::uint32_t loop = graph_->loop_at(v);
  if (loop == none) {
    return;
  }
  const auto& points = graph_->surface().points;
  const double key = nodes_[v].key;
  const double bound = nodes_[target].search == search_ ? nodes_[target].key : infinite;
  for (const std::uint32_t q : graph_->loop(loop)) {
    const double distance = length(points[q] - points[v]);
    const double reached = key + distance;
    Node& node = nodes_[q];
    if (q == v || reached >= bound || (node.search == search_ && reached >= node.key) || distance == 0.0) {
      continue;
    }
    if (!graph_->starts_inside(v, q, distance)) {
      continue;
    }
    if (node.search != search_) {
      node.search = search_;
      node.estimate = static_cast<float>(length(points[target] - points[q]));
    }
    node.key = reached;
    node.from = v;
    node.arc = jump_arc;
    push(static_cast<float>(reached) + node.estimate, q);
  }
}

double ValleySearch::find(std::uint32_t from, std::uint32_t to, std::vector<Step>& path) {
  ++search_;
  heap_.clear();
  path.clear();
  const auto& points = graph_->surface().points;
  const Vec3 goal = points[to];
  nodes_[from] = {0.0, static_cast<float>(length(goal - points[from])), search_, none, none};
  push(nodes_[from].estimate, from);
  while (!heap_.empty()) {
    const std::uint64_t entry = pop();
    const auto v = static_cast<std::uint32_t>(entry & 0xffffffffU);
    const double key = nodes_[v].key;
    if (heap_entry(static_cast<float>(key) + nodes_[v].estimate, v) != entry) {
      continue;  // a shorter way was found since
    }
    if (v == to) {
      break;
    }
    graph_->for_arcs(v, [&](std::uint32_t i, const Arc& arc) {
      const double reached = key + static_cast<double>(arc.length);
      Node& node = nodes_[arc.target];
      if (node.search != search_) {
        node.search = search_;
        node.estimate = static_cast<float>(length(goal - points[arc.target]));
      } else if (reached >= node.key) {
        return;
      }
      node.key = reached;
      node.from = v;
      node.arc = i;
      push(static_cast<float>(reached) + node.estimate, arc.target);
    });
    relax_jumps(v, to);
  }
  if (nodes_[to].search != search_) {
    return infinite;
  }
  for (std::uint32_t v = to; v != none; v = nodes_[v].from) {
    path.push_back({v, nodes_[v].arc});
  }
  std::reverse(path.begin(), path.end());
  return nodes_[to].key;
}

void ValleySearch::flood(std::span<const Start> starts, double limit, std::vector<std::uint32_t>& reached) {
  ++search_;
  heap_.clear();
  reached.clear();
  double least = 0.0;
  for (const Start& s : starts) {
    least = std::min(least, s.key);
  }
  // Keys in the heap are counted from the least start, so that none is negative.
  for (const Start& s : starts) {
    Node& node = nodes_[s.vertex];
    if (s.key < limit && (node.search != search_ || s.key < node.key)) {
      node = {s.key, 0.0F, search_, none, none};
      push(static_cast<float>(s.key - least), s.vertex);
    }
  }
  while (!heap_.empty()) {
    const std::uint64_t entry = pop();
    const auto v = static_cast<std::uint32_t>(entry & 0xffffffffU);
    Node& here = nodes_[v];
    if (heap_entry(static_cast<float>(here.key - least), v) != entry || here.from == v) {
      continue;
    }
    here.from = v;  // settled
    reached.push_back(v);
    const double key = here.key;
    graph_->for_arcs(v, [&](std::uint32_t, const Arc& arc) {
      const double next = key + static_cast<double>(arc.length);
      Node& node = nodes_[arc.target];
      if (next >= limit || (node.search == search_ && next >= node.key)) {
        return;
      }
      if (node.search == search_ && node.from == arc.target) {
        return;  // settled; rounding of float keys only
      }
      node = {next, 0.0F, search_, none, none};
      push(static_cast<float>(next - least), arc.target);
    });
  }
}

}  // namespace ridgecraft::segment
