// SPDX-License-Identifier: GPL-3.0-or-later
// A segmentation as numbers of the polygons that a model was made from.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/model/model.hpp"
#include "segment/parts/segmentation.hpp"

namespace ridgecraft::segment {

/// Of a polygon that has no face: repair dropped it.
inline constexpr std::uint32_t no_part = std::numeric_limits<std::uint32_t>::max();

/// The part of each polygon of the file, or of the points and polygons that were repaired, in its order; or
/// no_part. `segmentation`: of the model's surface, with each polygon in one part. O(n).
[[nodiscard]] std::vector<std::uint32_t> polygon_labels(const mesh::Model& model,
                                                        const Segmentation& segmentation);

}  // namespace ridgecraft::segment
