// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valley_search.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::segment {
namespace {

/// Width of the queue's buckets, in mean lengths of an arc: about a dozen buckets are then in use at once.
constexpr double bucket_share = 0.125;

}  // namespace

ValleySearch::ValleySearch(const PartGraph& graph)
    : graph_(&graph),
      nodes_(graph.surface().vertex_count()),
      bucket_width_(static_cast<float>(bucket_share * graph.mean_arc_length())) {}

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
    queue_.push(static_cast<float>(reached) + node.estimate, q);
  }
}

bool ValleySearch::comes_first(std::uint32_t v, std::uint32_t other) const {
  const float a = static_cast<float>(nodes_[v].key) + nodes_[v].estimate;
  const float b = static_cast<float>(nodes_[other].key) + nodes_[other].estimate;
  return a != b ? a < b : v < other;
}

double ValleySearch::find(std::uint32_t from, std::uint32_t to, std::vector<Step>& path) {
  ++search_;
  path.clear();
  const auto& points = graph_->surface().points;
  const Vec3 goal = points[to];
  nodes_[from] = {0.0, static_cast<float>(length(goal - points[from])), search_, none, none};
  queue_.start(nodes_[from].estimate, bucket_width_);
  queue_.push(nodes_[from].estimate, from);
  // Entries behind that of the goal are never taken: they aren't even pushed.
  float bound = std::numeric_limits<float>::infinity();
  BucketQueue::Entry entry{};
  while (queue_.pop(entry)) {
    if (queue_.is_past(bound)) {
      break;
    }
    const std::uint32_t v = entry.vertex;
    const double key = nodes_[v].key;
    if (static_cast<float>(key) + nodes_[v].estimate != entry.key || v == to) {
      continue;  // a shorter way was found since, or this is the goal
    }
    graph_->for_arcs(v, [&](std::uint32_t i, const Arc& arc) {
      const double reached = key + static_cast<double>(arc.length);
      Node& node = nodes_[arc.target];
      const bool fresh = node.search != search_;
      if (!fresh && reached >= node.key) {
        // Of two ways of one length, the one over the vertex that an exact queue would have taken first.
        if (reached == node.key && arc.length > 0.0F && comes_first(v, node.from)) {
          node.from = v;
          node.arc = i;
        }
        return;
      }
      const float estimate = fresh ? static_cast<float>(length(goal - points[arc.target])) : node.estimate;
      const float through = static_cast<float>(reached) + estimate;
      if (through > bound) {
        return;
      }
      node = {reached, estimate, search_, v, i};
      queue_.push(through, arc.target);
      if (arc.target == to) {
        bound = through;
      }
    });
    relax_jumps(v, to);
    bound = nodes_[to].search == search_ ? static_cast<float>(nodes_[to].key) : bound;
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
  queue_.start(0.0F, bucket_width_);
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
      queue_.push(static_cast<float>(s.key - least), s.vertex);
    }
  }
  BucketQueue::Entry entry{};
  while (queue_.pop(entry)) {
    const std::uint32_t v = entry.vertex;
    const double key = nodes_[v].key;
    if (static_cast<float>(key - least) != entry.key) {
      continue;  // a shorter way was found since
    }
    if (nodes_[v].from != v) {
      nodes_[v].from = v;  // counted
      reached.push_back(v);
    }
    graph_->for_arcs(v, [&](std::uint32_t, const Arc& arc) {
      const double next = key + static_cast<double>(arc.length);
      Node& node = nodes_[arc.target];
      const bool fresh = node.search != search_;
      if (next >= limit || (!fresh && next >= node.key)) {
        return;
      }
      node.key = next;
      if (fresh) {
        node.search = search_;
        node.from = none;
      }
      queue_.push(static_cast<float>(next - least), arc.target);
    });
  }
}

}  // namespace ridgecraft::segment
