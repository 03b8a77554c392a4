// SPDX-License-Identifier: GPL-3.0-or-later
// The objective of the search for nets: what a forest costs its builder, mm of seam, and what a move adds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "unfold/energy/cut_costs.hpp"
#include "unfold/energy/tree_shape.hpp"
#include "unfold/search/forest.hpp"

namespace ridgecraft::unfold {

/// The sum of the costs of cuts (CutCosts) and of pieces (TreeShape), kept up to date.
class ForestEnergy {
 public:
  /// `part`: per face of the forest's patch. All must outlive this.
  ForestEnergy(const Forest& forest, std::span<const std::uint32_t> part, const CutFacts& facts,
               const Room& room, const Weights& weights);

  /// Looks at the forest again. O(n).
  void renew();
  [[nodiscard]] double total() const { return cut_costs_.total() + shapes_; }
  /// Without any term of tabs.
  [[nodiscard]] double total_without_bare() const { return cut_costs_.total_without_bare() + shapes_; }
  [[nodiscard]] const CutCosts& cut_costs() const { return cut_costs_; }

  /// What a legal move would add to total(); nothing where its cuts alone cost more than `most`. A move that
  /// is rated must be followed by keep(), when the forest has made it, or drop().
  [[nodiscard]] std::optional<double> rate(const Move& move, double most);
  [[nodiscard]] double rated_bare() const { return cut_costs_.change_of_bare(); }
  void keep();
  void drop();
  void weigh_images(double times) { cut_costs_.weigh_images(times); }
  [[nodiscard]] std::uint64_t work() const { return shape_.work(); }
  /// Whether all pieces that the rated move makes surely fit the room.
  [[nodiscard]] bool rated_fits() const;
  /// Whether all pieces fit the room. O(1) for those that clearly do.
  [[nodiscard]] bool all_fit() { return !one_that_does_not_fit(); }
  /// A tree that doesn't.
  [[nodiscard]] std::optional<std::uint32_t> one_that_does_not_fit();

 private:
  void find_roots(const Forest::Carried& what);
  void set_folds(const Move& move, bool made);

  const Forest& forest_;
  const Patch& patch_;
  const Room& room_;
  CutCosts cut_costs_;
  TreeShape shape_;
  std::vector<TreeShape::Measure> measure_;  ///< per number of a tree
  Folds folds_;
  double shapes_ = 0.0;

  // The move that was rated last.
  Move move_;
  std::array<std::uint32_t, 2> roots_{no_index, no_index};  ///< a face of each tree that it makes
  std::array<TreeShape::Measure, 2> measures_;
  double change_ = 0.0;
};

}  // namespace ridgecraft::unfold
