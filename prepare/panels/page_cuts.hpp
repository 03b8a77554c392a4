// SPDX-License-Identifier: GPL-3.0-or-later
// A flat region laid into the plane, and what straight cuts make of it. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// Two places that are one: a stretch of paper that two tiles share.
struct Link {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  Vec2 from;
  Vec2 to;
};

/// Convex tiles that hang together over links.
struct FlatShape {
  std::vector<std::vector<Vec2>> tiles;  ///< counterclockwise
  std::vector<Link> links;

  [[nodiscard]] double area() const;
  [[nodiscard]] std::vector<Vec2> points() const;
};

/// The lines dot(p, across) == at[i], ascending; `across` has length 1.
struct Cuts {
  Vec2 across{1.0, 0.0};
  std::vector<double> at;
};

struct Reach {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double size() const { return high - low; }
};
/// From where to where the points reach in a direction.
[[nodiscard]] Reach reach(const std::vector<Vec2>& points, Vec2 direction);

/// What the cuts make: connected shapes, strip by strip. O(tiles * cuts).
[[nodiscard]] std::vector<FlatShape> cut_shape(const FlatShape& shape, const Cuts& cuts);

/// Length of the cuts inside the shape.
[[nodiscard]] double cut_length(const FlatShape& shape, const Cuts& cuts);

// Where a flat region that is larger than the page is cut. Private to prepare/.

/// Can what has these points be laid into the rectangle, turned as need be? O(n log n).
[[nodiscard]] bool fits_page(const std::vector<Vec2>& points, Vec2 page);

/// Parallel cuts that begin to make the shape fit: what is left may need cuts of its own. Tried are strips of
/// one width, each cut across into lengths of one size, along the sides of the shape and along its narrowest
/// rectangle, and single cuts that run on along a side from a concave corner. The fewest pieces win, strips
/// counting twice, then the shortest cuts. `sides` are the shape's outline; the shape must not fit the page.
[[nodiscard]] Cuts plan_cuts(const FlatShape& shape, const std::vector<std::array<Vec2, 2>>& sides, Vec2 page,
                             const Context& context);

}  // namespace ridgecraft::prepare
