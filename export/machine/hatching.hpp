// SPDX-License-Identifier: GPL-3.0-or-later
// Areas as lines, for what only draws lines.
#pragma once

#include <array>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Lines of 45 degrees, so many mm apart, as far as they lie in a simple polygon; each by its ends. Lines of
/// all polygons of a page lie in one pattern. O(lines * corners).
[[nodiscard]] std::vector<std::array<Vec2, 2>> hatching(const std::vector<Vec2>& polygon, double apart_mm);

}  // namespace ridgecraft::export_
