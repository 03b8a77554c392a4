// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest point of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

using Triangle3 = std::array<Vec3, 3>;

/// The point of a triangle, which may be without area, that is nearest to p.
[[nodiscard]] Vec3 nearest_on(const Triangle3& triangle, Vec3 p);

/// A binary tree of boxes over triangles, halved at the median centre of the longest direction. Built in O(n
/// log n); a query takes about O(log n).
class SurfaceTree {
 public:
  /// At least one triangle.
  explicit SurfaceTree(std::vector<Triangle3> triangles);

  /// A nearest point and the triangle that it lies on.
  struct Place {
    Vec3 point;
    std::uint32_t triangle = 0;
  };
  /// The nearest point of the surface; as soon as one is found that isn't farther than `enough`, that one
  /// will do. Looks at the triangle of `guess` first: that of a point nearby is often the one.
  [[nodiscard]] Place nearest(Vec3 p, double enough, const Place& guess) const;
  [[nodiscard]] const std::vector<Triangle3>& triangles() const { return triangles_; }

 private:
  struct Node {
    Box3 box;
    std::uint32_t begin = 0, end = 0;  ///< its triangles
    std::uint32_t right = 0;           ///< 0 for a leaf; the left child follows its parent
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  struct Search;
  void descend(std::uint32_t at, Search& search) const;

  std::vector<Triangle3> triangles_;  ///< in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace ridgecraft::verify
