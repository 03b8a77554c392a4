// SPDX-License-Identifier: GPL-3.0-or-later
// The outline of points seen from one direction: edges of their hull that are found without the hull.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::segment {

/// Convex outlines of points in a projection. Each side of an outline is an edge of the points' hull, as long
/// as no face of the hull is seen edge-on; up to the rounding of doubles.
class Shadow {
 public:
  /// Finds the outline in the plane of two directions at right angles. `corners()` and `longest()` hold until
  /// the next call. O(n), and O(k log k) for the k points near the outline.
  void cast(std::span<const Vec3> points, std::span<const std::uint32_t> ids, Vec3 right, Vec3 up);
  /// Numbers of the points at the outline's corners, counterclockwise; none when there are no points.
  [[nodiscard]] std::span<const std::uint32_t> corners() const { return corners_; }
  /// The side that is longest in space; the same number twice for less than two corners.
  [[nodiscard]] std::array<std::uint32_t, 2> longest(std::span<const Vec3> points) const;

 private:
  struct Spot {
    double x;
    double y;
    std::uint32_t id;
  };
  void drop_inner();

  std::vector<Spot> spots_;
  std::vector<Spot> chain_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace ridgecraft::segment
