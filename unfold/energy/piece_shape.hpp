// SPDX-License-Identifier: GPL-3.0-or-later
// What the shape of a piece costs: the hollows of its outline, its necks, what hangs over the sheet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/net/piece_rules.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"
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

}  // namespace ridgecraft::unfold
