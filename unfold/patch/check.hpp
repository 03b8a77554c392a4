// SPDX-License-Identifier: GPL-3.0-or-later
// The independent check of finished nets: all pairs of faces, by other formulas than the search uses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "unfold/patch/layout.hpp"
#include "unfold/patch/triangle.hpp"

namespace ridgecraft::unfold {

struct OverlapFound {
  std::uint32_t first = 0;  ///< indices into the triangles that were given, first < second
  std::uint32_t second = 0;
  double depth = 0.0;  ///< mm
};

/// Penetration depth by the Minkowski difference: the distance from the origin to the outline of the convex
/// hull of all differences of corners; 0 or less when the origin isn't inside. Shares no code with
/// unfold/patch/triangle.hpp.
[[nodiscard]] double depth_by_difference(const Triangle& a, const Triangle& b);

/// Every pair of these triangles that is deeper than the tolerance (mm). A sweep over x skips the pairs whose
/// boxes are apart, no other. O(n log n + pairs of boxes that meet).
[[nodiscard]] std::vector<OverlapFound> find_overlaps(std::span<const Triangle> triangles, double tolerance);

/// find_overlaps for each piece of a layout by itself; indices are the layout's faces.
[[nodiscard]] std::vector<OverlapFound> find_overlaps(const Layout& layout, double tolerance);

}  // namespace ridgecraft::unfold
