// SPDX-License-Identifier: GPL-3.0-or-later
// Whether air lies deep under the hull of a part: what --pockets promises about (docs/design/segmentation.md,
// "More effort, smaller hulls, no pockets").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/hull/deepest_point.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/hull_planes.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Tests hulls against the solid that a closed surface encloses. A pocket is a point outside the solid that
/// lies deeper than a tolerance under every face of the hull. What lies so deep is a convex body, the hull
/// with its faces moved inward; it holds air exactly when its deepest point is air or a face of the surface
/// with air beside it reaches into it. So the answer is exact, not sampled.
class PocketTest {
 public:
  PocketTest(const ScaledSurface& surface, double tolerance);

  /// Whether there is a solid to speak of: no border edges.
  [[nodiscard]] static bool encloses(const ScaledSurface& surface);

  /// O(facets of the surface) when the hull is thicker than twice the tolerance.
  [[nodiscard]] bool has_pocket(const Hull& hull);

  /// Winding number of the surface about a point that isn't on it. O(facets).
  [[nodiscard]] int winding(Vec3 point) const;

 private:
  void find_planes(const Hull& hull);
  [[nodiscard]] bool reaches_in(std::uint32_t facet, std::size_t& last, Vec3& where) const;
  [[nodiscard]] bool has_air_beside(std::uint32_t facet, Vec3 where);

  const ScaledSurface* surface_;
  double tolerance_;
  std::vector<HullPlane> hull_planes_;
  std::vector<HalfSpace> planes_;  ///< the same, moved inward by the tolerance
  std::vector<std::int8_t> air_;   ///< per facet: whether air is beside it, -1 not known yet
};

}  // namespace ridgecraft::segment
