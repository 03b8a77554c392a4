// SPDX-License-Identifier: GPL-3.0-or-later
// Which pieces of a finely cut surface belong together: few parts, small hulls, borders along creases.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "base/context.hpp"
#include "segment/concavity/hull_rays.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/pocket_test.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/edge_weights.hpp"

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

/// A set of pieces that was measured.
struct PieceSet {
  bool feasible = false;  ///< may be one part; else nothing more is known
  std::vector<std::uint32_t> hull_vertices;
  std::vector<RaySpan> rays;  ///< through its hull
};

/// Joins connected pieces, each within the tolerance, to parts that are, too. What was measured of a set of
/// pieces is known for the rest of the run, so many orders of joining share their tests.
class Partition {
 public:
  /// All must outlive this. `pockets`: parts mustn't have any; null: they may. Without a price of volume or
  /// border, all joins that are possible are made. `mode`: one of the tests.
  Partition(Measurer& measurer, const EdgeWeights& weights, const PartitionCost& cost, PocketTest* pockets,
            MeasureMode mode, std::vector<Facets> pieces);

  /// Joins pairs, convex borders first, as long as that lowers the cost; then tears a few neighbouring parts
  /// up in each round and joins their pieces in another order (`noise` is added to the smoothness of their
  /// borders), and keeps what costs less. Rounds end early where so much was measured that more would take
  /// too long. Parts ascend by smallest facet.
  [[nodiscard]] std::vector<AssembledPart> run(unsigned rounds, double noise, Random& random);
  /// Makes all joins that are possible, convex borders first, whatever they cost: the merge pass.
  [[nodiscard]] std::vector<AssembledPart> join_all();
  /// Of what was returned last.
  [[nodiscard]] double cost() const { return least_; }

 private:
  using Key = std::vector<std::uint32_t>;  ///< pieces, ascending
  struct Border {
    double length = 0.0;
    double smoothness = 0.0;
  };
  struct Group {
    Key pieces;
    std::map<std::uint32_t, Border> beside;  ///< by group
    PieceSet* set = nullptr;
  };
  using Groups = std::vector<Group>;

  [[nodiscard]] PieceSet& set_of(const Key& key);
  PieceSet& measured(const Key& key, const PieceSet& a, const PieceSet& b);
  void describe(const Hull& hull, PieceSet& set) const;
  [[nodiscard]] double cost_of(const Groups& groups) const;
  void find_borders();
  [[nodiscard]] double added_volume(const PieceSet& set, std::uint32_t g, std::uint32_t h) const;
  [[nodiscard]] static std::vector<Key> keys_of(const Groups& groups);
  [[nodiscard]] std::vector<Key> single_pieces() const;
  void fill_cover(const Groups& groups);
  Groups groups_of(const std::vector<Key>& keys);
  void join(Groups& groups, double noise, Random& random);
  [[nodiscard]] std::vector<AssembledPart> parts_of(const std::vector<Key>& keys);
  [[nodiscard]] std::vector<Key> torn(const std::vector<Key>& parts, Random& random);
  [[nodiscard]] static Key united(const Key& a, const Key& b);
  void unite(Groups& groups, std::uint32_t g, std::uint32_t h, Key key, PieceSet& set);
  void gather(const Key& key);

  Measurer* measurer_;
  const EdgeWeights* weights_;
  PartitionCost cost_;
  PocketTest* pockets_;
  MeasureMode mode_;
  bool at_any_cost_ = false;
  double least_ = 0.0;
  std::vector<Facets> pieces_;
  std::vector<std::map<std::uint32_t, Border>> beside_;
  std::map<Key, PieceSet> known_;
  /// Stretches on each ray inside the hulls of the groups that are being joined.
  struct Slab {
    std::uint32_t group = 0;
    RaySpan span;
  };
  std::vector<std::vector<Slab>> cover_;
  Measurement measurement_;
  HullBuilder hulls_;
  Hull hull_;
  Facets facets_;
  std::size_t facet_count_ = 0;  ///< of all pieces
  std::size_t work_ = 0;         ///< facets of all sets that were measured
};

}  // namespace ridgecraft::segment
