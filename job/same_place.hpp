// SPDX-License-Identifier: GPL-3.0-or-later
// Where nets made before lie in a model that may have another size now, or has changed here and there.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::job {

/// The points of a surface, found by place.
class PointSet {
 public:
  /// `share` of the surface's largest extent lies between points that count as one. O(n log n).
  PointSet(const mesh::Surface& surface, double share);

  /// The share of these points that are points of the surface. O(log n) each.
  [[nodiscard]] double share_of(std::span<const Vec3> points) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell_of(Vec3 p) const;
  [[nodiscard]] bool contains(Vec3 p) const;

  double size_;
  std::set<Cell> cells_;
};

/// p becomes here + factor * (p - there).
struct Similarity {
  Vec3 there;
  Vec3 here;
  double factor = 1.0;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return here + factor * (p - there); }
};

/// Takes points of nets to the surface that they were made of: box to box, in the way in which most points
/// meet points of the surface. Finds the place, too, where the model grew or shrank at some sides of its box,
/// as long as one of its extents stayed. O(n log n). `points`: at least one.
[[nodiscard]] Similarity same_place(std::span<const Vec3> points, const mesh::Surface& surface);

}  // namespace ridgecraft::job
