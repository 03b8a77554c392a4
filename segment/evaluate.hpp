// SPDX-License-Identifier: GPL-3.0-or-later
// How good a segmentation is: volume of the hulls, agreement with people (specification 20).
#pragma once

#include <cstdint>
#include <span>

#include "mesh/context.hpp"
#include "mesh/surface.hpp"

namespace ridgecraft::segment {

/// Volume that the surface encloses, in its unit cubed: the sum of signed tetrahedra.
[[nodiscard]] double enclosed_volume(const mesh::Surface& surface);

/// Volume of the union of the convex hulls of the parts, divided by the volume that the surface encloses
/// (20.2): rays through the centres of a grid of `rays` by `rays` cells over the enclosing ball. `label`:
/// part of each face, any numbers. 0 when the surface encloses nothing. Within 0.001 at 128 rays a side.
[[nodiscard]] double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label,
                                       unsigned rays, const Context& context);

/// 1 - Rand index of two labelings: share of the pairs of faces on which they disagree about "same part"
/// (20.4). Faces count equally. 0 for fewer than two faces.
[[nodiscard]] double rand_error(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

}  // namespace ridgecraft::segment
