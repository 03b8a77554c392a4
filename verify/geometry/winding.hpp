// SPDX-License-Identifier: GPL-3.0-or-later
// What a surface goes around, also where it is open.
#pragma once

#include <vector>

#include "verify/geometry/surface_tree.hpp"

namespace ridgecraft::verify {

/// How often the triangles go around a point: 1 inside a closed surface, 0 outside, about a half in a flat
/// opening (Jacobson, Kavan, Sorkine-Hornung: Robust inside-outside segmentation using generalized winding
/// numbers, 2013). O(n).
[[nodiscard]] double winding(const std::vector<Triangle3>& triangles, Vec3 p);

}  // namespace ridgecraft::verify
