// SPDX-License-Identifier: GPL-3.0-or-later
// How good a segmentation is: volume of the hulls of its parts (specification 20). Agreement with people is
// in agreement.hpp.
#pragma once

#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

/// Volume that the surface encloses, in its unit cubed: the sum of signed tetrahedra.
[[nodiscard]] double enclosed_volume(const mesh::Surface& surface);

/// Volume of the union of the convex hulls of the parts, divided by the volume that the surface encloses
/// (20.2): rays through the centres of a grid of `rays` by `rays` cells over the enclosing ball. `label`:
/// part of each face, any numbers. 0 when the surface encloses nothing. Within 0.001 at 128 rays a side.
[[nodiscard]] double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label,
                                       unsigned rays, const Context& context);

}  // namespace ridgecraft::segment
