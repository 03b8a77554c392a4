// SPDX-License-Identifier: GPL-3.0-or-later
// A closed triangle mesh, counterclockwise from outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::solid {

/// A closed triangle mesh, counterclockwise seen from outside.
struct Body {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Mass properties at density 1, in the points' unit.
struct MassProperties {
  double volume = 0.0;
  Vec3 center;
  /// About the centre: xx, yy, zz, xy, xz, yz, with the signs of the inertia tensor.
  std::array<double, 6> inertia{};
};

/// By signed tetrahedra from the origin. O(n).
[[nodiscard]] MassProperties mass_properties(const Body& body);
/// Of several bodies as if they shared no space.
[[nodiscard]] MassProperties mass_properties(std::span<const Body> bodies);

}  // namespace ridgecraft::solid
