// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of a piece run through each other while it is folded in one way or another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "unfold/folding/fold_motion.hpp"

namespace ridgecraft::unfold {

/// Two faces meet where they are in each other deeper than fold_give_mm. Faces that meet in the folded piece,
/// too, belong to a model that runs through itself, and don't count.
class FoldTrial {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< of faces, the smaller number first

  FoldTrial(const FoldMotion& motion, const Context& context);

  /// Whether nothing meets while all creases are folded at a time, growing alike: 24 samples, O(n log n)
  /// each.
  [[nodiscard]] bool together_works();
  /// The pairs that meet then, one for each sample in which they do; stops at the first sample with more than
  /// `most` in all.
  [[nodiscard]] std::vector<Pair> meetings_together(std::size_t most);
  /// Whether nothing meets while one crease is folded after the other: 6 samples each, in which only what the
  /// crease moves is compared with the rest. False, too, at the deadline.
  [[nodiscard]] bool order_works(std::span<const std::uint32_t> order);

 private:
  using Corners = std::array<Vec3, 3>;
  /// A face less the seam in which it gives way.
  struct Solid {
    Corners corners;
    Box3 box;
    bool empty = true;
  };

  [[nodiscard]] Solid solid(std::uint32_t face) const;
  [[nodiscard]] bool counts(std::uint32_t f, std::uint32_t g) const;
  [[nodiscard]] std::vector<Pair> meetings() const;
  void pose_together(double share);
  [[nodiscard]] bool crease_works(std::uint32_t crease, std::vector<Solid>& solids);

  const FoldMotion& motion_;
  const Context& context_;
  FoldMotion::Pose pose_;
  std::vector<Pair> always_;  ///< faces that meet in the folded piece, ascending
};

}  // namespace ridgecraft::unfold
