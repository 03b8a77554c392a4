// SPDX-License-Identifier: GPL-3.0-or-later
// Faces without area: paper can't hold them. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// A height below this share of the longest side is none: far below what a coordinate of a file can say.
inline constexpr double no_height = 1e-9;

/// Is the triangle without area in the sense of this header?
[[nodiscard]] bool is_flat(Vec3 a, Vec3 b, Vec3 c);

/// Removes the flat triangles without opening the surface: where two corners are at one place they become one
/// point; where a corner lies on the side opposite, the triangles beyond that side get the corner, too. Works
/// on any list. Returns how many of the triangles given were flat. O(n log n).
std::size_t collapse_flat_triangles(TriangleList& list, const Context& context);

}  // namespace ridgecraft::mesh
