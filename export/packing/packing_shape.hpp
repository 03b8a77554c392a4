// SPDX-License-Identifier: GPL-3.0-or-later
// A piece as the packer sees it: convex bits of paper (faces and tabs), and the turns that are worth a try.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/motion.hpp"
#include "base/vector.hpp"

namespace ridgecraft::paper {

/// Smaller overlaps with a rectangle's border count as touching, mm: a tenth of what the contract allows, far
/// above rounding.
inline constexpr double fit_tolerance_mm = 1e-4;

/// The outline's interior as convex polygons; they may overlap each other.
struct PackingShape {
  std::vector<std::vector<Vec2>> convex;
  std::vector<Vec2> hull;         ///< of all of them, counterclockwise
  double area = 0.0;              ///< sum of the polygons' areas, mm2
  std::vector<Turn> along_grain;  ///< turns to be kept to, where it fits in one of them; none: any will do
};

[[nodiscard]] PackingShape packing_shape(std::vector<std::vector<Vec2>> convex);

/// Width and height of the turned points.
[[nodiscard]] Vec2 extent(std::span<const Vec2> hull, Turn turn);

/// A turn in which the hull fits the rectangle, the one with most room to spare among those where that can
/// change; none if there is no such turn. Exact: all turns where the extents pass an extreme or a limit are
/// tried, between which they run along sine curves (rotating calipers, Shamos 1978). O(h^2) for h hull
/// corners in the worst case. (Whether there is any such turn is angle_to_fit() of base/rectangle.hpp; the
/// packer wants the roomiest.)
[[nodiscard]] std::vector<Turn> fitting_turns(std::span<const Vec2> hull, Vec2 area);

/// At most `most` turns in which the hull fits the rectangle, the most promising first: sides of the smallest
/// enclosing rectangles along the page's sides, in all four directions, and some between. Empty where it fits
/// in none.
[[nodiscard]] std::vector<Turn> promising_turns(std::span<const Vec2> hull, Vec2 area, std::size_t most);

/// At most `most` turns in which the shape fits the rectangle: those along the grain, else promising ones.
[[nodiscard]] std::vector<Turn> turns_to_try(const PackingShape& shape, Vec2 area, std::size_t most);

}  // namespace ridgecraft::paper
