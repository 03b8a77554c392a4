// SPDX-License-Identifier: GPL-3.0-or-later
// What a piece costs by its shape and by what it holds: hollows, outline, necks, size, parts, what hangs over
// the sheet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/search/forest.hpp"

namespace ridgecraft::unfold {

/// Measures the trees of a forest one by one, mm:
/// - compact: the area of the convex hull that is no paper. The hull is taken as the polygon of 16 sides
///   around the piece, one of them along its longer axis: a few percent too large, in O(n) without sorting;
/// - outline: its square, so that ragged pieces cost more than several calm ones;
/// - thin: of each fold, by how much the branch behind it is wider than three times the fold;
/// - pieces, parts, small, panels: that it is there, and what it has;
/// - what it hangs over the sheet, at the best of eight turns, and panels beyond what it may have.
class TreeShape {
 public:
  struct Measure {
    double cost = 0.0;        ///< mm
    bool surely_fits = true;  ///< at one of eight turns it lies on the sheet, with few enough panels
  };

  /// `part`: per face of the patch. All must outlive this.
  TreeShape(const Patch& patch, std::span<const std::uint32_t> part, const Room& room,
            const Weights& weights);

  /// The tree that hangs together at `root` by `folds`; `forest` has its faces in the plane, those of `moved`
  /// (if given) before they are moved. O(its faces).
  [[nodiscard]] Measure measure(const Forest& forest, const Folds& folds, std::uint32_t root,
                                const Forest::Carried* moved);

  struct Member {
    std::uint32_t face = 0;
    std::uint32_t parent = 0;  ///< its place among the members
    std::uint32_t up = 0;      ///< the face's side to it; nothing at the root
    double behind = 0.0;       ///< area of the face with all that hangs on it
  };
  /// Those of the tree that was measured last, the root first, parents before children.
  [[nodiscard]] std::span<const Member> faces() const { return {members_.data(), count_}; }
  [[nodiscard]] std::size_t panels() const { return panels_; }
  /// Of all trees that were measured so far, the number of faces.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  static constexpr std::size_t directions = 8;

  void collect(const Folds& folds, std::uint32_t root);
  [[nodiscard]] double necks(const Folds& folds) const;
  [[nodiscard]] double overhang(const std::array<float, 2 * directions>& reach) const;

  const Patch& patch_;
  std::span<const std::uint32_t> part_;
  const Room& room_;
  Weights weights_;
  std::vector<double> area_;          ///< per face
  std::vector<std::uint8_t> narrow_;  ///< per side (narrow_sides)
  std::vector<std::uint64_t> part_in_;
  std::vector<Member> members_;  ///< the first `count_`
  std::uint32_t count_ = 0;
  std::size_t panels_ = 1;
  std::size_t parts_ = 1;
  double outline_ = 0.0;
  std::vector<Vec2> points_;
  std::uint64_t work_ = 0;
  std::uint64_t question_ = 0;
};

}  // namespace ridgecraft::unfold
