// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest point of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/box_tree.hpp"
#include "base/vector.hpp"

namespace ridgecraft::verify {

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
  /// the way of the search (base/box_tree.hpp: one way for one list); as soon as one is found that isn't
  /// farther than `enough`, that one will do. Looks at the triangle of `guess` first: that of a point nearby
  /// is often the one.
  [[nodiscard]] Place nearest(Vec3 p, double enough, const Place& guess) const;
  [[nodiscard]] const std::vector<Triangle3>& triangles() const { return triangles_; }

 private:
  BoxTree<Box3> tree_;
  std::vector<Triangle3> triangles_;  ///< in the order of the leaves
};

}  // namespace ridgecraft::verify
