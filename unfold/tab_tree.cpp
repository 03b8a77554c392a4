// SPDX-License-Identifier: GPL-3.0-or-later
// Start trees for tabs.
#include <algorithm>

#include "mesh/disjoint_sets.hpp"
#include "unfold/tab_search.hpp"
#include "unfold/tab_targets.hpp"

namespace ridgecraft::unfold {

namespace {

/// A side of the patch for each edge, with what speaks for cutting it.
struct RatedEdge {
  double rating = 0.0;
  std::uint32_t side = 0;
};

std::vector<RatedEdge> rate_edges(const mesh::Surface& surface, const mesh::Panels& panels,
                                  const Patch& patch, const TabOptions& options, Random& random) {
  const TabTargets targets = find_tab_targets(surface, panels, patch, options);
  std::vector<RatedEdge> edges;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin == nothing || twin < side) {
      continue;
    }
    const double chances =
        (targets.largest[side].empty() ? 0.0 : 1.0) + (targets.largest[twin].empty() ? 0.0 : 1.0);
    // A long edge is worth half a side.
    edges.push_back({chances + 0.02 * std::min(patch.length[side], 25.0) + 0.2 * random.unit(), side});
  }
  return edges;
}

}  // namespace

Folds tab_friendly_tree(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                        const TabOptions& options, Random& random) {
  const std::vector<RatedEdge> edges = rate_edges(surface, panels, patch, options, random);
  std::vector<std::vector<RatedEdge>> at(surface.vertex_count());
  const auto ends = [&](std::uint32_t side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    return std::pair(surface.vertex(c), surface.vertex(mesh::next(c)));
  };
  const auto better = [](const RatedEdge& a, const RatedEdge& b) {
    return a.rating != b.rating ? a.rating > b.rating : a.side < b.side;
  };
  for (const RatedEdge& edge : edges) {
    if (patch.frozen[edge.side] == 0) {
      at[ends(edge.side).first.value()].push_back(edge);
      at[ends(edge.side).second.value()].push_back(edge);
    }
  }
  for (auto& list : at) {
    std::sort(list.begin(), list.end(), better);
  }
  std::vector<std::uint8_t> seen(surface.vertex_count(), 0);
  std::vector<std::uint8_t> cut(patch.twin.size(), 0);
  std::vector<std::pair<std::uint32_t, std::size_t>> stack;
  const std::uint32_t first = ends(3 * random.below(patch.size())).first.value();
  stack.emplace_back(first, 0);
  seen[first] = 1;
  while (!stack.empty()) {
    auto& [vertex, tried] = stack.back();
    if (tried == at[vertex].size()) {
      stack.pop_back();
      continue;
    }
    const std::uint32_t side = at[vertex][tried++].side;
    const auto [a, b] = ends(side);
    const std::uint32_t other = a.value() == vertex ? b.value() : a.value();
    if (seen[other] == 0) {
      seen[other] = 1;
      cut[side] = 1;
      stack.emplace_back(other, 0);
    }
  }
  // Folds: inside panels first, then where nothing is cut, the worst edges for tabs first.
  std::vector<RatedEdge> order = edges;
  const auto group = [&](const RatedEdge& edge) {
    return patch.frozen[edge.side] != 0 ? 0 : 1 + cut[edge.side];
  };
  std::sort(order.begin(), order.end(), [&](const RatedEdge& a, const RatedEdge& b) {
    return group(a) != group(b) ? group(a) < group(b) : better(b, a);
  });
  DisjointSets sets(patch.size());
  Folds folds(patch.twin.size(), 0);
  for (const RatedEdge& edge : order) {
    const std::uint32_t twin = patch.twin[edge.side];
    if (sets.join(edge.side / 3, twin / 3)) {
      folds[edge.side] = folds[twin] = 1;
    }
  }
  return folds;
}

}  // namespace ridgecraft::unfold
