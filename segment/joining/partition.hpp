// SPDX-License-Identifier: GPL-3.0-or-later
// Which pieces of a finely cut surface belong together: few parts, small hulls, borders along creases.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/hull/pockets.hpp"

namespace ridgecraft::segment {

// Borders between sets of facets, and in which order they have their turn.

/// Where two sets of facets meet.
struct Border {
  double length = 0.0;
  double smoothness = 0.0;  ///< Theta (cutting/cut.hpp) times length, summed over the edges

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

// The volume of the union of hulls that are joined one by one, measured on rays.

/// The stretches of all rays inside the hulls of some groups.
class HullUnion {
 public:
  /// Empties it. Without rays everything is 0, and costs nothing.
  void start(bool with_rays);
  /// `rays`: the stretches inside the group's hull.
  void add(std::uint32_t group, std::span<const RaySpan> rays);
  /// Two groups become one, of number g, with this hull, which holds theirs.
  void unite(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays);

  /// Length of the union on all rays; times volume_per_length() its volume.
  [[nodiscard]] double length() const;
  /// By how much it grows when two groups become one with this hull.
  [[nodiscard]] double added_length(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays) const;

 private:
  struct Slab {
    std::uint32_t group = 0;
    RaySpan span;
  };
  std::vector<std::vector<Slab>> slabs_;  ///< of each ray
};

// Sets of pieces, and which of them may be one part.

/// A set of pieces that was measured.
struct PieceSet {
  std::vector<std::uint32_t> pieces;  ///< ascending
  bool feasible = false;              ///< may be one part; else nothing more is known
  std::vector<std::uint32_t> hull_vertices;
  std::vector<RaySpan> rays;  ///< through its hull, where they are wanted
};

/// What decides whether a set may be one part.
struct PieceTest {
  PocketTest* pockets = nullptr;  ///< parts mustn't have any; null: they may
  bool from_scratch = false;      ///< how sets are measured (measure.hpp)
  bool wants_rays = false;
};

/// Pieces and all sets of them that were measured: known from then on, so many orders of joining share their
/// tests.
class PieceSets {
 public:
  /// The measurer and the test's pockets must outlive this. Each piece is connected, feasible, ascending.
  PieceSets(Measurer& measurer, const PieceTest& test, std::vector<Facets> pieces);

  [[nodiscard]] std::size_t piece_count() const { return pieces_.size(); }
  [[nodiscard]] const Facets& piece(std::uint32_t piece) const { return pieces_[piece]; }
  /// Of all sets; references hold as long as this lives.
  [[nodiscard]] const PieceSet& operator[](std::uint32_t set) const { return sets_[set]; }

  /// Number of the set of a single piece.
  [[nodiscard]] std::uint32_t single(std::uint32_t piece);
  /// Number of the set that unites two feasible ones without a common piece. Measured when that wasn't done
  /// yet.
  [[nodiscard]] std::uint32_t united(std::uint32_t one, std::uint32_t other);
  /// Facets of a set, ascending.
  [[nodiscard]] Facets facets(std::uint32_t set) const;

  /// Facets of all sets that were measured, as a share of those of all pieces.
  [[nodiscard]] double work() const {
    return static_cast<double>(measured_facets_) / static_cast<double>(facet_count_);
  }
  [[nodiscard]] const ScaledSurface& surface() const { return measurer_->graph().surface(); }
  [[nodiscard]] const Context& context() const { return measurer_->context(); }

 private:
  void describe(const Hull& hull, PieceSet& set) const;

  Measurer* measurer_;
  PieceTest test_;
  std::vector<Facets> pieces_;
  std::deque<PieceSet> sets_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> number_;  ///< of the set of these pieces
  HullBuilder hulls_;
  Measurement measurement_;
  std::size_t facet_count_ = 0;  ///< of all pieces
  std::size_t measured_facets_ = 0;
};

/// What a partition costs: 1 for each part, and these.
struct PartitionCost {
  double volume = 0.0;       ///< of one unit_volume of the union of the parts' hulls
  double border = 0.0;       ///< of one ball radius of border along edges that aren't concave
  double unit_volume = 1.0;  ///< in cubed radii
};

struct AssembledPart {
  Facets facets;
  bool joined = false;  ///< of several pieces
};

/// Parts, ascending by smallest facet, and what they cost together.
struct Assembled {
  std::vector<AssembledPart> parts;
  double cost = 0.0;
};

/// Joins connected pieces, each within the tolerance, to parts that are, too.
class Partition {
 public:
  /// Both must outlive this. With a price of volume the sets must know the rays through their hulls.
  Partition(PieceSets& sets, const EdgeWeights& weights, const PartitionCost& cost);

  /// Joins pairs, convex borders first, as long as that lowers the cost (without a price of volume or border
  /// it always does), or at any cost: the merge pass.
  [[nodiscard]] Assembled join_pieces(bool at_any_cost);
  /// Joins pairs as long as that lowers the cost; then tears a few neighbouring parts up in each round and
  /// joins their pieces in another order (up to `noise` is added to the smoothness of their borders), and
  /// keeps what costs less. Rounds end early where so much was measured that more would take too long.
  [[nodiscard]] Assembled search(unsigned rounds, double noise, Random& random);

 private:
  /// Pieces that are joined; without a set when it went into another one.
  struct Group {
    std::uint32_t set = no_index;
    std::map<std::uint32_t, Border> beside;  ///< by group
  };
  using Groups = std::vector<Group>;
  /// Which joins are made and in which order.
  struct Joining {
    bool at_any_cost = false;
    double noise = 0.0;
    Random* random = nullptr;  ///< of the noise
  };

  void find_borders();
  [[nodiscard]] std::vector<std::uint32_t> single_pieces();
  [[nodiscard]] Groups groups_of(const std::vector<std::uint32_t>& sets) const;
  [[nodiscard]] static std::vector<std::uint32_t> sets_of(const Groups& groups);
  [[nodiscard]] double cost_of(const Groups& groups) const;
  [[nodiscard]] double gain_of(const Groups& groups, const Pair& pair, std::uint32_t united) const;
  void join(Groups& groups, const Joining& joining);
  void unite(Groups& groups, const Pair& pair, std::uint32_t united);
  [[nodiscard]] std::vector<std::uint32_t> torn(const std::vector<std::uint32_t>& parts, Random& random);
  [[nodiscard]] std::vector<AssembledPart> parts_of(const std::vector<std::uint32_t>& sets) const;

  PieceSets* sets_;
  const EdgeWeights* weights_;
  PartitionCost cost_;
  std::vector<std::map<std::uint32_t, Border>> beside_;  ///< of each piece, by piece
  HullUnion hulls_;                                      ///< of the groups that were joined last
};

}  // namespace ridgecraft::segment
