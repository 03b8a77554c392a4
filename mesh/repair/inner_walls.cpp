// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/inner_walls.hpp"

#include <algorithm>
#include <span>

#include "base/disjoint_sets.hpp"
#include "base/edge_order.hpp"

namespace ridgecraft::mesh {
namespace {

constexpr std::uint32_t no_pair = Soup::none;

struct WallSide {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t pair;  ///< or no_pair
  bool forward;
};

/// An edge at which walls lie: which, and whether the rest closes there.
struct WallEdge {
  std::vector<std::uint32_t> pairs;  ///< each once
  std::size_t others = 0;            ///< sides of polygons that are in no pair
  bool balanced = false;             ///< these run as often one way as the other
};

/// All edges of walls. Sides of polygons that name a point twice are skipped where they run from it to
/// itself.
std::vector<WallEdge> wall_edges(const PolygonList& list, const std::vector<WallPair>& pairs) {
  std::vector<std::uint32_t> pair_of(list.size(), no_pair);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    pair_of[pairs[i][0]] = pair_of[pairs[i][1]] = i;
  }
  std::vector<WallSide> sides;
  sides.reserve(list.corners.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto polygon = list.polygon(i);
    std::uint32_t p = polygon.back();
    for (const std::uint32_t q : polygon) {
      if (p != q) {
        sides.push_back({std::min(p, q), std::max(p, q), pair_of[i], p < q});
      }
      p = q;
    }
  }
  const std::vector<WallSide> ordered = in_edge_order(std::span<const WallSide>(sides));
  std::vector<WallEdge> edges;
  for (std::size_t i = 0; i < ordered.size();) {
    WallEdge edge;
    std::ptrdiff_t balance = 0;
    std::size_t j = i;
    for (; j < ordered.size() && ordered[j].low == ordered[i].low && ordered[j].high == ordered[i].high;
         ++j) {
      if (ordered[j].pair == no_pair) {
        ++edge.others;
        balance += ordered[j].forward ? 1 : -1;
      } else if (std::find(edge.pairs.begin(), edge.pairs.end(), ordered[j].pair) == edge.pairs.end()) {
        edge.pairs.push_back(ordered[j].pair);
      }
    }
    edge.balanced = balance == 0;
    if (!edge.pairs.empty()) {
      edges.push_back(std::move(edge));
    }
    i = j;
  }
  return edges;
}

/// Marks the pairs that are sheets: those that end where nothing else is or where the rest stays open, and
/// those that then end there because others were marked.
std::vector<bool> find_sheets(const std::vector<WallEdge>& edges, std::size_t pair_count) {
  std::vector<std::vector<std::uint32_t>> edges_of(pair_count);
  std::vector<std::size_t> walls(edges.size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    walls[e] = edges[e].pairs.size();
    open.push_back(e);
    for (const std::uint32_t p : edges[e].pairs) {
      edges_of[p].push_back(e);
    }
  }
  std::vector<bool> sheet(pair_count, false);
  while (!open.empty()) {
    const std::uint32_t e = open.back();
    open.pop_back();
    const WallEdge& edge = edges[e];
    if (edge.balanced && (edge.others > 0 || walls[e] != 1)) {
      continue;
    }
    for (const std::uint32_t p : edge.pairs) {
      if (!sheet[p]) {
        sheet[p] = true;
        for (const std::uint32_t other : edges_of[p]) {
          --walls[other];
          open.push_back(other);
        }
      }
    }
  }
  return sheet;
}

}  // namespace

std::vector<WallPair> walls_between_solids(const PolygonList& list, const std::vector<WallPair>& pairs) {
  const std::vector<WallEdge> edges = wall_edges(list, pairs);
  const std::vector<bool> sheet = find_sheets(edges, pairs.size());
  // Walls that hang together have a rim somewhere, or they are a body of their own drawn from both sides.
  DisjointSets sets(pairs.size());
  std::vector<std::uint32_t> rim;
  for (const WallEdge& edge : edges) {
    std::vector<std::uint32_t> walls;
    std::copy_if(edge.pairs.begin(), edge.pairs.end(), std::back_inserter(walls),
                 [&](std::uint32_t p) { return !sheet[p]; });
    for (const std::uint32_t p : walls) {
      sets.join(walls.front(), p);
    }
    if (edge.others > 0 && walls.size() % 2 == 1) {
      rim.push_back(walls.front());
    }
  }
  std::vector<bool> has_rim(pairs.size(), false);
  for (const std::uint32_t p : rim) {
    has_rim[sets.find(p)] = true;
  }
  std::vector<WallPair> found;
  for (std::uint32_t p = 0; p < pairs.size(); ++p) {
    if (!sheet[p] && has_rim[sets.find(p)]) {
      found.push_back(pairs[p]);
    }
  }
  return found;
}

}  // namespace ridgecraft::mesh
