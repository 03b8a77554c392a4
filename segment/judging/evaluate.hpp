// SPDX-License-Identifier: GPL-3.0-or-later
// How good a segmentation is: volume of the hulls of its parts. Agreement with people is in agreement.hpp.
#pragma once

#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

/// Volume that the surface encloses, in its unit cubed: the sum of signed tetrahedra.
[[nodiscard]] double enclosed_volume(const mesh::Surface& surface);

/// Volume of the union of the convex hulls of the parts, divided by the volume that the surface encloses:
/// rays through the centres of a grid of `rays` by `rays` cells over the enclosing ball. `label`: part of
/// each face, any numbers. 0 when the surface encloses nothing. At 128 rays a side within 0.001; up to 1.5 %
/// off where many faces are parallel to the rays. A flat part has no volume; the hulls of parts that are open
/// shells needn't fill a thick body, so ratios below 1 are possible.
[[nodiscard]] double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label,
                                       unsigned rays, const Context& context);

}  // namespace ridgecraft::segment
