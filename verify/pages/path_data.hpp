// SPDX-License-Identifier: GPL-3.0-or-later
// The "d" of an SVG path as lines.
#pragma once

#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// One list of points for each subpath, in the path's own unit; a closed one ends where it begins, one
/// without a line is left out. Straight lines only (M, L, H, V, Z, large or small): throws NotInForm for
/// others. O(size).
[[nodiscard]] std::vector<std::vector<Vec2>> path_lines(std::string_view data);

}  // namespace ridgecraft::verify
