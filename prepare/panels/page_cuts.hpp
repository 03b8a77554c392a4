// SPDX-License-Identifier: GPL-3.0-or-later
// Where a flat region that is larger than the page is cut. Private to prepare/.
#pragma once

#include <array>
#include <vector>

#include "base/context.hpp"
#include "prepare/panels/flat_shape.hpp"

namespace ridgecraft::prepare {

/// Can what has these points be laid into the rectangle, turned as need be? O(n log n).
[[nodiscard]] bool fits_page(const std::vector<Vec2>& points, Vec2 page);

/// Parallel cuts that begin to make the shape fit: what is left may need cuts of its own. Tried are strips of
/// one width, each cut across into lengths of one size, along the sides of the shape and along its narrowest
/// rectangle, and single cuts that run on along a side from a concave corner. The fewest pieces win, strips
/// counting twice, then the shortest cuts. `sides` are the shape's outline; the shape must not fit the page.
[[nodiscard]] Cuts plan_cuts(const FlatShape& shape, const std::vector<std::array<Vec2, 2>>& sides, Vec2 page,
                             const Context& context);

}  // namespace ridgecraft::prepare
