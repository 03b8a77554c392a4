// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of the plane, motions of space and surfaces in it: how deep polygons lie in each other, how nets
// are folded and laid on the model, the nearest point of a surface.
#pragma once

#include <array>
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

// Turns and shifts of space: how nets are folded, and how a folded piece is laid on the model.

/// A turn as a unit quaternion w + xi + yj + zk.
struct Turn {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  /// By an angle in radians about a direction of length 1, counterclockwise seen from its tip.
  [[nodiscard]] static Turn about(Vec3 direction, double angle);
  [[nodiscard]] Vec3 operator()(Vec3 p) const;
  /// First b, then a; kept at length 1.
  friend Turn operator*(const Turn& a, const Turn& b);
};

/// p goes to turn(p) + shift.
struct Motion {
  Turn turn;
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
};

/// The motion without mirroring that lays `from` on `to` with the least sum of squared distances (Horn 1987:
/// the turn is the eigenvector to the largest eigenvalue of a symmetric 4 by 4 matrix). As many points in
/// both, at least one.
[[nodiscard]] Motion best_motion(std::span<const Vec3> from, std::span<const Vec3> to);

// The nearest point of a surface.

using Triangle3 = std::array<Vec3, 3>;

/// The point of a triangle, which may be without area, that is nearest to p.
[[nodiscard]] Vec3 nearest_on(const Triangle3& triangle, Vec3 p);

/// Triangles in a tree of boxes. Built in O(n log n); a query takes about O(log n).
class SurfaceTree {
 public:
  /// At least one triangle.
  explicit SurfaceTree(const std::vector<Triangle3>& triangles);

  /// A nearest point and the triangle that it lies on.
  struct Place {
    Vec3 point;
    std::uint32_t triangle = 0;
  };
  /// The nearest point of the surface, of the first triangle in triangles() where several have it as near on
  /// the way of the search (base/boxes.hpp: one way for one list); as soon as one is found that isn't
  /// farther than `enough`, that one will do. Looks at the triangle of `guess` first: that of a point nearby
  /// is often the one.
  [[nodiscard]] Place nearest(Vec3 p, double enough, const Place& guess) const;
  [[nodiscard]] const std::vector<Triangle3>& triangles() const { return triangles_; }

 private:
  BoxTree<Box3> tree_;
  std::vector<Triangle3> triangles_;  ///< in the order of the leaves
};

// What a surface goes around, also where it is open.

/// How often the triangles go around a point: 1 inside a closed surface, 0 outside, about a half in a flat
/// opening (Jacobson, Kavan, Sorkine-Hornung: Robust inside-outside segmentation using generalized winding
/// numbers, 2013). O(n).
[[nodiscard]] double winding(const std::vector<Triangle3>& triangles, Vec3 p);

}  // namespace ridgecraft::verify
