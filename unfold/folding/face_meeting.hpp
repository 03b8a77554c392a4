// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two faces of a piece that is being folded are in each other.
#pragma once

#include <array>

#include "base/vector.hpp"

namespace ridgecraft::unfold {

/// Of a triangle in space, mm.
using Corners = std::array<Vec3, 3>;

/// The triangle less a seam of fold_give_mm (net/tolerance.hpp) along its sides, in which it gives way; false
/// where nothing is left. `rest` may be `t`.
[[nodiscard]] bool without_seam(const Corners& t, Corners& rest);

/// Whether two triangles have a point in common. Floating point decides: for triangles without their seams,
/// which are a million times wider than its errors, it can't be wrong about faces that share a side.
[[nodiscard]] bool meet(const Corners& f, const Corners& g);

}  // namespace ridgecraft::unfold
