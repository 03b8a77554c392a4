// SPDX-License-Identifier: GPL-3.0-or-later
// Where parallel rays run inside a solid and inside convex bodies: volumes of unions and differences without
// the topology of either. Private to solid/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {

/// What a ray passes through from one height to another.
struct Stretch {
  std::uint32_t ray = 0;
  double from = 0.0;
  double to = 0.0;
};
/// Ascending by ray and height; those of one ray share no point.
using Stretches = std::vector<Stretch>;

/// Sum of the lengths.
[[nodiscard]] double total(const Stretches& stretches);
/// What lies in any of them; in any order, and they may overlap. O(n log n).
[[nodiscard]] Stretches united(Stretches any);
/// What lies in `a` and not in `b`. O(n).
[[nodiscard]] Stretches difference(const Stretches& a, const Stretches& b);

/// Rays parallel to one axis, one through each cell of a square grid.
class Rays {
 public:
  /// `axis`: 0 to 2; rays fill the box, `step` apart.
  Rays(const Box3& box, unsigned axis, double step);

  [[nodiscard]] unsigned axis() const { return axis_; }
  /// The point of a ray at a height along the axis.
  [[nodiscard]] Vec3 point(std::uint32_t ray, double height) const;
  /// Where rays are inside the solid that some faces of a surface enclose: where it winds around them, so
  /// bodies may overlap, and cavities count as outside.
  [[nodiscard]] Stretches inside(const mesh::Surface& surface, std::span<const FaceId> faces) const;
  /// Where rays are inside a convex body.
  [[nodiscard]] Stretches inside(const Body& convex) const;

 private:
  /// Calls visit(ray, height, sign) where rays meet a triangle; sign is +1 where they leave through it. Of
  /// two triangles at an edge a ray meets one, however the edge is rounded.
  template <class Visit>
  void for_each_hit(const std::array<Vec3, 3>& corners, const Visit& visit) const;
  [[nodiscard]] std::array<double, 3> turned(Vec3 p) const;
  [[nodiscard]] std::uint32_t cell_of(double x, unsigned direction) const;
  [[nodiscard]] Vec2 place(std::uint32_t i, std::uint32_t j) const;

  unsigned axis_;
  double step_;
  std::array<double, 2> low_{};           ///< of the box, across the rays
  std::array<std::uint32_t, 2> count_{};  ///< rays in both directions
};

}  // namespace ridgecraft::solid
