// SPDX-License-Identifier: GPL-3.0-or-later
// Flat faces side by side along something that is bent one way. Private to prepare/.
#pragma once

#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// Of each panel: whether it is a slat, a face of a ruled strip (prepare/panels/ruled_strips.hpp) that is as
/// long as a fold can be short and not much narrower. Collapses edge by edge would set slats askew, so they
/// are walls. Faces between edges of 75 degrees and more are none: steps and grooves aren't bent. O(n).
[[nodiscard]] std::vector<bool> find_slats(const mesh::Surface& surface, const Panels& panels,
                                           double short_edge_mm);

}  // namespace ridgecraft::prepare
