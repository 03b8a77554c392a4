// SPDX-License-Identifier: GPL-3.0-or-later
// The planes of a hull's triangles, but for slivers (docs/design/segmentation.md, "Bridges").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "segment/hull/hull.hpp"

namespace ridgecraft::segment {

/// A plane that has the hull behind it.
struct HullPlane {
  Vec3 normal;               ///< unit, outwards
  double offset = 0.0;       ///< of its points along the normal
  std::uint32_t number = 0;  ///< of its triangle
};

/// Whether a triangle with these corners is too thin to say where its plane runs. Hulls of CAD-like meshes
/// have such triangles, with three corners nearly on one edge.
[[nodiscard]] bool is_sliver(Vec3 a, Vec3 b, Vec3 c);

/// Replaces `planes` by those of all triangles that aren't slivers, in order.
void find_hull_planes(const Hull& hull, std::span<const Vec3> points, std::vector<HullPlane>& planes);

}  // namespace ridgecraft::segment
