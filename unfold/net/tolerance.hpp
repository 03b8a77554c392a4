// SPDX-License-Identifier: GPL-3.0-or-later
// Every tolerance of unfold/, its unit and its reason.
#pragma once

#include <algorithm>

namespace ridgecraft::unfold {

/// Penetration depth of two faces in the finished nets, mm: a tenth of what verify/ and the contract allow.
inline constexpr double overlap_tolerance_mm = 1e-4;

/// Penetration depth during the search, as a share of the surface's largest extent. Rounding along the fold
/// tree stays near 1e-15 of it, so there are eight decades of room on one side and print accuracy on the
/// other.
inline constexpr double search_tolerance = 1e-7;

/// What a search takes for a surface of this largest extent, mm: half of what the finished nets may show,
/// whatever its size.
[[nodiscard]] constexpr double net_tolerance(double extent) {
  return std::min(search_tolerance * extent, 0.5 * overlap_tolerance_mm);
}

/// Two copies of an edge that lie this near to each other, mm, are one: a tenth of what the contract allows a
/// length to be off, a thousand times what rounding does.
inline constexpr double closing_tolerance_mm = 1e-6;

/// How far closing such an edge may move what lies a model's size away, when the edge belongs to a narrow
/// face, mm: a tenth of what the contract allows a model of 100 mm to be off when it is folded again.
inline constexpr double closing_lever_mm = 1e-4;

/// Faces that run into each other less deep than this while a piece is folded pass each other, mm: card bends
/// that far out of the way.
inline constexpr double fold_give_mm = 0.3;

}  // namespace ridgecraft::unfold
