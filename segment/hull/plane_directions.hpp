// SPDX-License-Identifier: GPL-3.0-or-later
// The planes of a hull, sorted by where they face: the near ones are found without a look at all of them.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "segment/hull/hull_planes.hpp"

namespace ridgecraft::segment {

/// Planes in cells of a cube whose sides are divided into squares, by direction: one cell's face nearly the
/// same way, and what of them is nearest is bounded by one product.
class PlaneDirections {
 public:
  /// Replaces all planes, of a hull round about `centre`: O(n). There are about as many cells as planes in
  /// one.
  void assign(std::span<const HullPlane> planes, Vec3 centre);

  /// The least distance from p (behind all planes or nearly so) to a plane that is at most `limit` away,
  /// whose normal's cosine to n is above `least_cosine`, and of which `counts(plane)` holds, asked only for
  /// planes nearer than all before; infinite when there is none. Typically O(sqrt n).
  template <typename Counts>
  [[nodiscard]] double nearest(Vec3 p, Vec3 n, double limit, double least_cosine, Counts counts) const {
    double nearest = std::numeric_limits<double>::infinity();
    double bound = limit;
    const Vec3 from_centre = p - centre_;
    for (const Cell& cell : cells_) {
      if (cell.least_offset - most(cell, from_centre) > bound + rounding ||
          most(cell, n) <= least_cosine - rounding) {
        continue;
      }
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
        const HullPlane& plane = planes_[i];
        const double distance = plane.offset - dot(plane.normal, p);
        if (distance <= bound && distance < nearest && dot(plane.normal, n) > least_cosine && counts(plane)) {
          nearest = bound = distance;
        }
      }
    }
    return nearest;
  }

 private:
  /// Of sums of three products, on the unit sphere.
  static constexpr double rounding = 1e-12;

  /// The planes planes_[begin] ... planes_[end - 1], at least one.
  struct Cell {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    double least_offset = std::numeric_limits<double>::infinity();  ///< from the centre
    Box3 normals;
  };

  /// The greatest product of v and a vector in the cell's box of normals.
  [[nodiscard]] static double most(const Cell& cell, Vec3 v) {
    const Vec3 low = cell.normals.low;
    const Vec3 high = cell.normals.high;
    return v.x * (v.x > 0.0 ? high.x : low.x) + v.y * (v.y > 0.0 ? high.y : low.y) +
           v.z * (v.z > 0.0 ? high.z : low.z);
  }

  Vec3 centre_;
  std::vector<HullPlane> planes_;  ///< by cell
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> place_;  ///< scratch: cell of each plane
  std::vector<std::uint32_t> first_;  ///< scratch: where each cell begins
};

}  // namespace ridgecraft::segment
