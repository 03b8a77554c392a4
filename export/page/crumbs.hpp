// SPDX-License-Identifier: GPL-3.0-or-later
// Stretches of lines that are too short to be meant: a knife would plunge and turn there.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Whole lines that aren't longer are left out, mm: nobody sees them, and what they touch is drawn.
inline constexpr double crumb_mm = 0.02;
/// Corners nearer to each other become one where the line hardly changes by it, mm.
inline constexpr double near_corners_mm = 0.05;

/// A polygon, or an open line, without corners that are near the one before or behind: each that goes lies
/// within same_line_mm (segment2.hpp) of the line that is left. At least three corners stay, of a line its
/// ends. O(n).
[[nodiscard]] std::vector<Vec2> without_crumbs(const std::vector<Vec2>& points, bool closed);

}  // namespace ridgecraft::export_
