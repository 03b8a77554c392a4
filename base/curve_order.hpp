// SPDX-License-Identifier: GPL-3.0-or-later
// Points in the order of a space-filling curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft {

/// Cells of the curve along each side of the box: 2 to this power.
inline constexpr unsigned curve_bits = 10;

/// Place on a Z-curve (Morton 1966) of a point whose coordinates are numbers of cells, 0 to 2^curve_bits - 1;
/// others count as the nearest of these, what is no number as 0.
[[nodiscard]] std::uint32_t place_on_curve(Vec3 cell);

/// Numbers of the points in the order in which the curve meets their cells; points of one cell keep theirs.
/// The points must be finite. Where their extent, or 1 / extent, isn't (below 1e-305), the order is coarser.
/// O(n).
[[nodiscard]] std::vector<std::uint32_t> curve_order(std::span<const Vec3> points);

}  // namespace ridgecraft
