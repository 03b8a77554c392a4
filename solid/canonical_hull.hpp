// SPDX-License-Identifier: GPL-3.0-or-later
// One convex body, one list of points and triangles. Private to solid/.
#pragma once

#include "solid/body.hpp"

namespace ridgecraft::solid {

/// The same convex body as its corners in the order of their coordinates, and each of its flat sides as a fan
/// from its first corner: what it is, whatever order its points were given in and wherever in memory they
/// lay (CGAL's hulls depend on both). Points within sides and edges go. Sides are told apart by exact
/// predicates. `hull`: convex, closed, of triangles that turn outwards. O(n log n).
[[nodiscard]] Body canonical_hull(const Body& hull);

}  // namespace ridgecraft::solid
