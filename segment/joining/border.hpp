// SPDX-License-Identifier: GPL-3.0-or-later
// Borders between sets of facets, and in which order they have their turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "segment/cutting/edge_weights.hpp"

namespace ridgecraft::segment {

/// Where two sets of facets meet.
struct Border {
  double length = 0.0;
  double smoothness = 0.0;  ///< Theta (edge_weights.hpp) times length, summed over the edges

  /// Adds the edge at side 3 f + k.
  void add_side(const ScaledSurface& surface, const EdgeWeights& weights, std::size_t side) {
    const double size = surface.side_length(side);
    length += size;
    smoothness += weights.smoothness(side) * size;
  }
  void add(const Border& other) {
    length += other.length;
    smoothness += other.smoothness;
  }
  /// Mean Theta: 1 where all edges are convex, less the more of them are concave; 0 without length.
  [[nodiscard]] double mean() const { return length > 0.0 ? smoothness / length : 0.0; }
};

/// Two sets, the smaller number first.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The borders of sets that grow together. `B`: a Border, or what has more to add.
template <class B>
class BorderGraph {
 public:
  explicit BorderGraph(std::size_t sets = 0) : beside_(sets) {}

  /// Number of a new set without borders.
  std::uint32_t add_set() {
    beside_.emplace_back();
    return static_cast<std::uint32_t>(beside_.size() - 1);
  }
  /// The border of two sets, a new one where there is none. Stays where it is until one of them is taken in.
  B& between(std::uint32_t p, std::uint32_t q) {
    beside_[p].insert(q);
    beside_[q].insert(p);
    return borders_[std::minmax(p, q)];
  }
  /// Those that a set has a border with.
  [[nodiscard]] const std::set<std::uint32_t>& beside(std::uint32_t p) const { return beside_[p]; }
  [[nodiscard]] const std::map<Pair, B>& all() const { return borders_; }

  /// `from` becomes part of `into`, and its borders those of `into`. Calls gone(pair) for each border that
  /// ends. O(borders of `from` * log n).
  template <class Gone>
  void take_in(std::uint32_t into, std::uint32_t from, const Gone& gone) {
    for (const std::uint32_t other : std::exchange(beside_[from], {})) {
      const auto at = borders_.find(std::minmax(from, other));
      const B moved = at->second;
      gone(at->first);
      borders_.erase(at);
      beside_[other].erase(from);
      if (other != into) {
        between(into, other).add(moved);
      }
    }
  }

 private:
  std::map<Pair, B> borders_;
  std::vector<std::set<std::uint32_t>> beside_;
};

/// Pairs that wait for their turn: those of least rank first, of equal ones the smallest numbers. O(log n)
/// for each change.
template <class Rank>
class PairQueue {
 public:
  [[nodiscard]] bool empty() const { return order_.empty(); }
  /// In place of an earlier rank of the same pair.
  void put(const Pair& pair, const Rank& rank) {
    drop(pair);
    rank_.emplace(pair, rank);
    order_.emplace(rank, pair);
  }
  void drop(const Pair& pair) {
    if (const auto at = rank_.find(pair); at != rank_.end()) {
      order_.erase({at->second, pair});
      rank_.erase(at);
    }
  }
  /// Takes the first one out; there must be one.
  Pair take() {
    const Pair pair = order_.extract(order_.begin()).value().second;
    rank_.erase(pair);
    return pair;
  }

 private:
  std::map<Pair, Rank> rank_;
  std::set<std::pair<Rank, Pair>> order_;
};

}  // namespace ridgecraft::segment
