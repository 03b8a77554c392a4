// SPDX-License-Identifier: GPL-3.0-or-later
// Areas in convex pieces, so that parts of them can be cut out line by line.
#pragma once

#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::paper {

/// What a closed outline covers, as trapezoids that don't overlap. It may touch itself, as where a slit leads
/// to a hole. Corners are rounded to a ten-millionth of its size. O(n log n) where its edges don't cross.
[[nodiscard]] std::vector<std::vector<Vec2>> trapezoids(const std::vector<Vec2>& outline);

}  // namespace ridgecraft::paper
