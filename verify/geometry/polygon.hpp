// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of the plane: orientation, whether they are simple, convex parts, and how deep two of them lie in
// each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/boxes.hpp"
#include "base/context.hpp"
#include "base/geometry.hpp"
#include "base/vector.hpp"

namespace ridgecraft::verify {

using Polygon = std::vector<Vec2>;

/// Of two segments that don't cross; of others that of the end that is nearest to the other segment.
[[nodiscard]] double segment_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// Turns left all the way round, once; corners may be straight within dent_tolerance_mm.
[[nodiscard]] bool is_convex(std::span<const Vec2> polygon);

/// No side crosses or touches another except its two neighbours in their common corners. A triangle is simple
/// when it has an area. About O(n log n) for polygons whose sides are spread, O(n²) at worst.
[[nodiscard]] bool is_simple(std::span<const Vec2> polygon, const Context& context);

/// The polygon as convex, counterclockwise polygons without common area: ears are cut off, then every
/// diagonal goes that two convex parts can do without (Hertel and Mehlhorn 1983). A polygon without area has
/// no parts; of one that isn't simple the parts cover all that it goes round, perhaps more. O(n r) with r
/// concave corners, O(n² r) at worst.
[[nodiscard]] std::vector<Polygon> convex_parts(std::span<const Vec2> polygon, const Context& context);

/// Penetration depth of two convex counterclockwise polygons: the shortest translation that separates their
/// interiors; 0 if they are apart or touch. It is the distance of the origin from the border of the Minkowski
/// difference, whose sides have the normals of both polygons (de Berg et al., Computational Geometry,
/// section 13.3). O(n m) for n and m corners.
[[nodiscard]] double penetration(std::span<const Vec2> a, std::span<const Vec2> b);

// Finds the boxes of the plane near a box.

/// Built once for a set of boxes, none empty, in O(n log n); O(log n) per query and box found when boxes are
/// spread.
class BoxFinder {
 public:
  explicit BoxFinder(const std::vector<Box2>& boxes)
      : tree_(
            boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
            [&](std::uint32_t i) { return 0.5 * (boxes[i].low + boxes[i].high); }) {
    boxes_.reserve(boxes.size());
    for (const std::uint32_t i : tree_.order()) {
      boxes_.push_back(boxes[i]);
    }
  }

  /// Calls visit(number) for each box that has more than a border point in common with this one, in no
  /// special order.
  template <typename Visit>
  void for_each_overlapping(const Box2& box, Visit&& visit) const {
    tree_.search([&](std::uint32_t node) { return overlap(tree_.box(node), box); },
                 [&](std::uint32_t i) {
                   if (overlap(boxes_[i], box)) {
                     visit(tree_.order()[i]);
                   }
                 });
  }

 private:
  static bool overlap(const Box2& a, const Box2& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
  }

  BoxTree<Box2> tree_;
  std::vector<Box2> boxes_;  ///< in the order of the leaves
};

}  // namespace ridgecraft::verify
