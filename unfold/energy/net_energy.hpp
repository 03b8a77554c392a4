// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of a net, in mm of seam: what makes it hard to cut, to glue and to look at.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "unfold/energy/cut_costs.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {

/// The energy of all pieces of a forest: of its cuts (CutCosts) and of the shape of each piece (PieceShape),
/// kept up to date while a net changes by swaps. A swap either stays in one piece or hands a branch from one
/// piece to another; the number of pieces stays.
class NetEnergy {
 public:
  /// `patch`: what the pieces are, without links; `net`: the tree that links them. All must outlive this.
  NetEnergy(const Patch& patch, const RootedNet& net, const CutFacts& facts, const Room& room,
            const Weights& weights);

  /// Looks at the net afresh. O(n).
  void set_tree();

  /// With the room for tabs that the outline's angles tell.
  [[nodiscard]] double total() const { return cut_costs_.total() + shape_cost_; }
  /// Without any term of tabs.
  [[nodiscard]] double total_without_bare() const { return cut_costs_.total_without_bare() + shape_cost_; }
  /// Of the shapes of all pieces.
  [[nodiscard]] double shape_cost() const { return shape_cost_; }
  [[nodiscard]] const CutCosts& cut_costs() const { return cut_costs_; }

  /// What a swap would add to total(); nothing where that is clearly more than `most`, where the swap isn't
  /// one of two pieces, or would give a piece more panels than it may have and one of the two had. A swap
  /// that is rated must be followed by keep(), when the net has made it, or drop().
  [[nodiscard]] std::optional<double> rate(const Swap& swap, double most);
  /// How much of what was rated last is due to room for tabs.
  [[nodiscard]] double rated_bare() const { return cut_costs_.change_of_bare(); }
  void keep();
  void drop();
  /// Mirror images count so many times as much from now on, those within the patch. O(n).
  void weigh_mirror(double times) { cut_costs_.weigh_mirror(times); }

  /// What rating took so far: the faces of all pieces that were measured.
  [[nodiscard]] std::uint64_t work() const { return shape_.work(); }
  /// Whether all pieces fit the room. O(1) for those that clearly do.
  [[nodiscard]] bool all_fit();

 private:
  struct Piece {
    std::uint32_t face = 0;  ///< one of it
    PieceShape::Measure shape;
  };

  void set_fold(std::uint32_t side, std::uint8_t folded) {
    folds_[side] = folds_[patch_.twin[side]] = folded;
  }
  [[nodiscard]] bool rate_shapes(std::uint32_t below);
  [[nodiscard]] std::uint32_t other_end(std::uint32_t fold) const;
  void relabel(std::uint32_t root, std::uint32_t number);

  const Patch& patch_;
  const RootedNet& net_;
  const Room& room_;
  CutCosts cut_costs_;
  PieceShape shape_;
  Folds folds_;  ///< of the pieces: without links
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> piece_;  ///< per face
  double shape_cost_ = 0.0;

  // The swap that was rated last.
  std::uint32_t cut_ = nothing;
  std::uint32_t fold_ = nothing;
  PieceShape::Measure first_;
  PieceShape::Measure second_;
  std::uint32_t second_root_ = nothing;
  double shapes_change_ = 0.0;
};

}  // namespace ridgecraft::unfold
