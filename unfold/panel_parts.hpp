// SPDX-License-Identifier: GPL-3.0-or-later
// Parts that end at the borders of panels, so that no cut runs through a flat region.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::unfold {

/// Gives each panel whole to the part that has most of its area (the smaller number where two have equally
/// much), and what a part has no longer in one with the rest to the neighbour with the longest border, so
/// that parts stay connected where they were. Parts that lose all their faces vanish; the others are numbered
/// anew by their smallest face. O(n log n) but for the crumbs, O(n) each.
[[nodiscard]] IdVector<FaceId, PartId> parts_of_whole_panels(const mesh::Surface& surface,
                                                             const prepare::Panels& panels,
                                                             const IdVector<FaceId, PartId>& part);

}  // namespace ridgecraft::unfold
