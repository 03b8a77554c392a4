// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces as the packer sees them: convex bits of paper (faces and tabs), the turns that are worth a try, and
// their distances; what is to be packed, and what comes back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// What a search costs, in words of bitmap that it reads: some 8 ms. On 90 models it needs 325 pages; 12
/// million words need 324, 100 million 319, and ten times as many no fewer.
inline constexpr std::uint64_t usual_search_work = 8'000'000;
inline constexpr std::uint64_t long_search_work = 100'000'000;

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
/// corners in the worst case. (Whether there is any such turn is angle_to_fit() of base/geometry.hpp; the
/// packer wants the roomiest.)
[[nodiscard]] std::vector<Turn> fitting_turns(std::span<const Vec2> hull, Vec2 area);

/// At most `most` turns in which the hull fits the rectangle, the most promising first: sides of the smallest
/// enclosing rectangles along the page's sides, in all four directions, and some between. Empty where it fits
/// in none.
[[nodiscard]] std::vector<Turn> promising_turns(std::span<const Vec2> hull, Vec2 area, std::size_t most);

/// At most `most` turns in which the shape fits the rectangle: those along the grain, else promising ones.
[[nodiscard]] std::vector<Turn> turns_to_try(const PackingShape& shape, Vec2 area, std::size_t most);

struct PackingTask {
  std::vector<PackingShape> shapes;  ///< each fits the area in some turn
  std::vector<std::uint32_t> group;  ///< of each shape; those of one group had better be on one page
  Vec2 area;                         ///< of a page, mm
  double gap = 0.0;                  ///< between shapes, mm; none to the border of the area
  /// Words of bitmap that the simple orders may read before the rest of them is left out, and the walk after
  /// them.
  std::uint64_t search_work = usual_search_work;
};

/// Where a shape lies: turned, then moved; the area's lower left corner is the origin.
struct Packed {
  std::uint32_t page = 0;
  Turn turn;
  Vec2 shift;
};

/// Distance of two convex polygons; 0 where they meet.
[[nodiscard]] double convex_distance(std::span<const Vec2> a, std::span<const Vec2> b);

/// A convex polygon and the piece that it belongs to.
struct OwnedPolygon {
  std::uint32_t owner;
  std::vector<Vec2> corners;
};

/// Pairs of owners of which some polygons are nearer to each other than `gap`, each once, the smaller number
/// first, ascending. A sweep over x: O(n log n) and the pairs whose boxes are near each other.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> too_near(
    const std::vector<OwnedPolygon>& polygons, double gap);

}  // namespace ridgecraft::export_
