// SPDX-License-Identifier: GPL-3.0-or-later
// A small box around a convex body, turned as it may be. Private to solid/.
#pragma once

#include <array>

#include "solid/body.hpp"

namespace ridgecraft::solid {

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
[[nodiscard]] Box smallest_box(const Body& hull);

}  // namespace ridgecraft::solid
