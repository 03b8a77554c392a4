// SPDX-License-Identifier: GPL-3.0-or-later
// The few tabs that a search tries on a side: no larger than usable, inside what the face behind them allows,
// in a form that is quickly tested against what stands around.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"

namespace ridgecraft::unfold {

/// A convex polygon of n corners with the outward normals of its sides.
template <std::size_t n>
struct Walled {
  std::array<Vec2, n> corner;
  std::array<Vec2, n> normal;
  std::array<double, n> offset{};  ///< dot(normal, x) on the side

  /// From corners that are set, counterclockwise.
  void build_walls() {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 along = corner[(i + 1) % n] - corner[i];
      const double size = length(along);
      normal[i] = size > 0.0 ? -perpendicular(along) / size : Vec2{};
      offset[i] = size > 0.0 ? dot(normal[i], corner[i]) : HUGE_VAL;
    }
  }
};

/// Do all corners of b lie at least `enough` beyond one side of a?
template <std::size_t n, std::size_t m>
[[nodiscard]] bool beyond_a_wall(const Walled<n>& a, const Walled<m>& b, double enough) {
  for (std::size_t i = 0; i < n; ++i) {
    const double least = a.offset[i] + enough;
    bool all = true;
    for (std::size_t k = 0; k < m && all; ++k) {
      all = dot(a.normal[i], b.corner[k]) >= least;
    }
    if (all) {
      return true;
    }
  }
  return false;
}

/// Are the polygons at least `gap` apart along a normal of either? Stricter than distance where two corners
/// are nearest.
template <std::size_t n, std::size_t m>
[[nodiscard]] bool walls_apart(const Walled<n>& a, const Walled<m>& b, double gap) {
  return beyond_a_wall(a, b, gap) || beyond_a_wall(b, a, gap);
}

/// A tab in the frame of shapes.hpp.
struct TabCandidate {
  Walled<4> whole;
  Walled<4> upper;        ///< what keeps the clearance from things that share a corner of the base
  bool at_left = false;   ///< reaches the corner at (0, 0)
  bool at_right = false;  ///< reaches the corner at (length, 0)
};

inline constexpr std::size_t most_candidates = 8;

/// Tabs inside `largest` (largest_tab over the whole edge, with nothing but the target as obstacle), the more
/// upright ones first; none where it is empty. At most most_candidates. O(1).
[[nodiscard]] std::vector<TabCandidate> tab_candidates(const ConvexShape& largest, double length,
                                                       const TabOptions& options);

}  // namespace ridgecraft::unfold
