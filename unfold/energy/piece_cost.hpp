// SPDX-License-Identifier: GPL-3.0-or-later
// What the shape of a piece costs: the hollows of its outline, its necks, what hangs over the sheet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// Measures the pieces of a forest one by one. Costs in mm:
/// - hollows: the area of the convex hull that is no paper (Weights::compact). The hull is taken as the
/// polygon of 16 sides
///   around the piece, one of them along its longer axis: a few percent too large, in O(n) without sorting;
/// - outline: its square, so that ragged pieces cost more than several calm ones (Weights::outline);
/// - necks: of each fold, by how much the branch behind it (the root of the smaller side's area) is wider
/// than
///   three times the fold (Weights::thin);
/// - what the piece hangs over the sheet, at the best of eight turns, and panels beyond what it may have.
class PieceShape {
 public:
  struct Measure {
    double cost = 0.0;        ///< mm
    std::size_t panels = 1;   ///< flat regions in it
    bool surely_fits = true;  ///< at one of eight turns it lies on the sheet, with few enough panels
  };

  /// The patch must outlive this.
  PieceShape(const Patch& patch, const Room& room, const Weights& weights);

  /// The piece that hangs together at `root` by folds of `folds`; `net` has its faces in the plane, those of
  /// `moved` (if given) before they are moved by `motion`. O(its faces).
  [[nodiscard]] Measure measure(const RootedNet& net, const Folds& folds, std::uint32_t root,
                                const RootedNet::Span* moved, const Rigid& motion);

  /// A face of a piece.
  struct Member {
    std::uint32_t face = 0;
    std::uint32_t parent = 0;  ///< its place among the members
    std::uint32_t up = 0;      ///< the face's side to it; nothing at the root
    double behind = 0.0;       ///< area of the face with all that hangs on it
  };
  /// Those of the piece that was measured last, the root first, parents before children.
  [[nodiscard]] std::span<const Member> faces() const { return {members_.data(), count_}; }
  /// Of all pieces that were measured so far, the number of faces.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  static constexpr std::size_t directions = 8;

  void collect(const Folds& folds, std::uint32_t root);
  [[nodiscard]] double necks(const Folds& folds) const;
  [[nodiscard]] double overhang(const std::array<float, 2 * directions>& reach) const;

  const Patch& patch_;
  const Room& room_;
  Weights weights_;
  std::vector<double> area_;          ///< per face
  std::vector<std::uint8_t> narrow_;  ///< per side (narrow_sides)
  // The piece that was measured last.
  std::vector<Member> members_;  ///< the first `count_`
  std::uint32_t count_ = 0;
  std::size_t panels_ = 1;
  double outline_ = 0.0;
  std::vector<Vec2> points_;  ///< its corners
  std::uint64_t work_ = 0;
};

// What a piece costs its maker: the terms of net/options.hpp, but for those that depend on tabs and on what
// other pieces are (bare, mirror).

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
