// SPDX-License-Identifier: GPL-3.0-or-later
// What would overlap after a swap: asked without making it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// Pairs of faces.
using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Answers what the half that a swap moves would run into. The net must outlive it.
class SwapOverlaps {
 public:
  /// Overlap is penetration deeper than tolerance (mm).
  SwapOverlaps(const RootedNet& net, double tolerance);

  /// How many pairs of faces would overlap across the new fold; `limit` where there are as many or more. What
  /// overlaps across the old fold now isn't taken into account.
  std::uint32_t count(std::uint32_t below, std::uint32_t side, std::uint32_t limit);
  /// Would the swap make no new overlap?
  [[nodiscard]] bool is_clean(std::uint32_t below, std::uint32_t side) { return count(below, side, 1) == 0; }
  /// The pairs that the last count came upon; may be swapped away.
  [[nodiscard]] FacePairs& found() { return found_; }

 private:
  /// Two nodes of the circle tree that come near each other when the first is carried to `centre`.
  struct Meeting {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Vec2 centre;
  };
  class Descent;

  const RootedNet& net_;
  double tolerance_;
  FacePairs found_;
  std::vector<Meeting> meetings_;        ///< space to work in
  std::vector<EdgedTriangle> moved_;     ///< per face: its corners after the swap that was asked about
  std::vector<std::uint64_t> moved_in_;  ///< question that moved_ is of
  std::uint64_t question_ = 0;
};

}  // namespace ridgecraft::unfold
