// SPDX-License-Identifier: GPL-3.0-or-later
// Which pieces of a finely cut surface belong together: few parts, small hulls, borders along creases.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/joining/border.hpp"
#include "segment/joining/hull_union.hpp"
#include "segment/joining/piece_sets.hpp"

namespace ridgecraft::segment {

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
    std::uint32_t set = none;
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
