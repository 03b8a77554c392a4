// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that a file gives point by point (PLY, OFF) or corner by corner (glTF, 3MF).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// 0xRRGGBB. Channels outside [0, 1] are brought into it; NaN is 1.
[[nodiscard]] std::uint32_t packed_colour(const Colour& colour);

/// Each corner takes the colour of its point. `of_point` holds one for each point, or is empty, which changes
/// nothing.
void colour_corners(Soup& soup, const std::vector<std::uint32_t>& of_point);

/// The last three corners have these colours; corners before that have none stay so.
void colour_last_triangle(Soup& soup, const std::array<std::uint32_t, 3>& colours);

/// Corners after the last coloured one have none.
void finish_corner_colours(Soup& soup);

}  // namespace ridgecraft::mesh
