// SPDX-License-Identifier: GPL-3.0-or-later
// Convex bodies around points: hulls with exact predicates (CGAL), boxes, polytopes of few vertices. Private
// to solid/: CGAL's meshes stay in the files that call it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {

/// Points with dot(normal, p) <= offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// The convex hull of points: its corners are some of them, so nothing is rounded. Points without volume are
/// given `thickness` first, to both sides. At least one point. It encloses them all: signs are exact.
/// O(n log n). Throws Error(interrupted) and Error(out_of_time).
[[nodiscard]] Body convex_hull(std::span<const Vec3> points, double thickness, const Context& context = {});

/// Volume of the convex hull of points: less work than the hull as a body. O(n log n).
[[nodiscard]] double hull_volume(std::span<const Vec3> points, const Context& context);

/// The hull of some of the points, chosen so that no other lies farther outside than `tolerance`. O(points *
/// triangles).
[[nodiscard]] Body nearly_convex_hull(std::span<const Vec3> points, double tolerance, double thickness,
                                      const Context& context);

/// True when no point lies outside a convex body, by exact predicates. O(points * triangles).
[[nodiscard]] bool encloses(const Body& convex, std::span<const Vec3> points);

/// Grows a convex body about its middle by a few units in the last place, again and again, until it encloses
/// the points. Rounding is what it mends; the caller sees to it that it nearly encloses them before.
void grow_until_enclosing(Body& convex, std::span<const Vec3> points, const Context& context);

/// A CGAL::Surface_mesh of triangles without removed elements: its points and triangles in their order. O(n).
template <class SurfaceMesh>
[[nodiscard]] Body body_of(const SurfaceMesh& mesh) {
  Body body;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    body.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    auto h = mesh.halfedge(f);
    for (std::uint32_t& corner : triangle) {
      corner = static_cast<std::uint32_t>(mesh.target(h));
      h = mesh.next(h);
    }
    body.triangles.push_back(triangle);
  }
  return body;
}

/// The same convex body as its corners in the order of their coordinates, and each of its flat sides as a fan
/// from its first corner: what it is, whatever order its points were given in and wherever in memory they
/// lay (CGAL's hulls depend on both). Points within sides and edges go. Sides are told apart by exact
/// predicates. `hull`: convex, closed, of triangles that turn outwards. O(n log n).
[[nodiscard]] Body canonical_hull(const Body& hull, const Context& context);

/// A convex body that encloses `hull` and has at most `max_vertices` (at least 8) vertices. It begins as a
/// box, and each further plane touches the hull where it is nearest to the body's farthest corner; of two
/// such bodies, from the box of the axes and from a small one, the one of less volume.
[[nodiscard]] Body enclosing_polytope(const Body& hull, std::size_t max_vertices, const Context& context);

/// A box around a convex body, turned as it may be.
struct Box {
  std::array<Vec3, 3> axes;  ///< unit, at right angles, right-handed
  Box3 along;                ///< extent along each axis

  /// Bits 0, 1 and 2 of i say whether it lies at the high end of the axis of that number.
  [[nodiscard]] Vec3 corner(unsigned i) const;
  [[nodiscard]] double volume() const;
};

/// The one along the coordinate axes. O(n).
[[nodiscard]] Box box_along_axes(const Body& hull);

/// The smallest box of those with a side on one of the hull's largest triangles and along one of its edges,
/// and of those along the coordinate axes. (The smallest of all needn't touch a whole side of the hull:
/// O'Rourke, "Finding minimal enclosing boxes", International Journal of Computer and Information Sciences
/// 14, 1985.) `hull`: at least one point. O(n) for n points.
[[nodiscard]] Box smallest_box(const Body& hull, const Context& context);

}  // namespace ridgecraft::solid
