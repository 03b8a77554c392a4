// SPDX-License-Identifier: GPL-3.0-or-later
// What a piece costs its maker: the terms of piece_rules.hpp, but for those that depend on tabs and on what
// other pieces are (bare, mirror).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "unfold/energy/cut_costs.hpp"
#include "unfold/net/piece_rules.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// For a piece whose tree alone changes: the number of its parts costs the same whatever that is.
inline constexpr std::size_t one_part = 1;

/// What an outline of so many mm costs.
[[nodiscard]] double outline_cost(double outline, const Weights& weights);

/// The cost of one piece under changing trees. The patch must outlive it.
class PieceCost {
 public:
  /// `parts`: of how many parts it has faces.
  PieceCost(const Patch& piece, std::size_t parts, const Weights& weights);

  /// `hull`: convex, of the piece laid flat. O(n).
  [[nodiscard]] double of(const Folds& tree, std::span<const Vec2> hull);

 private:
  const Patch& piece_;
  Weights weights_;
  CutCosts cuts_;                     ///< without tabs
  double any_tree_;                   ///< whatever the tree is, with the outline's seams
  double border_ = 0.0;               ///< outline that belongs to other pieces or to none, mm
  std::vector<double> area_;          ///< of each face, mm2
  double whole_area_ = 0.0;           ///< of all
  std::vector<std::uint8_t> narrow_;  ///< per side (narrow_sides)
  std::vector<std::uint32_t> place_;  ///< space to work in
};

/// The cost of one piece: the sum of its terms, each times its weight. `tree`: its folds; `parts`: of how
/// many parts it has faces. O(n log n).
[[nodiscard]] double cost_of_piece(const Patch& piece, const Folds& tree, std::size_t parts,
                                   const Weights& weights);

/// What a piece of these faces costs at least, whatever its tree is.
[[nodiscard]] double least_cost_of_piece(const Patch& piece, std::size_t parts, const Weights& weights);

}  // namespace ridgecraft::unfold
