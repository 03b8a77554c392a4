// SPDX-License-Identifier: GPL-3.0-or-later
// How large boxes and surfaces are.
#pragma once

#include "mesh/foundation/vector.hpp"
#include "mesh/surface.hpp"

namespace ridgecraft::mesh {

/// The longest side of a box.
[[nodiscard]] double largest_extent(const Box3& box);

/// Linear.
[[nodiscard]] double total_area(const Surface& surface);

}  // namespace ridgecraft::mesh
