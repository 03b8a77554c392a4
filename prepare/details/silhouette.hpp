// SPDX-License-Identifier: GPL-3.0-or-later
// What a body covers, seen from a direction. Private to prepare/.
#pragma once

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// How much a body covers of what a larger one covers that encloses it, both seen along a unit vector: from 0
/// to 1. What is seen through a hole of the body counts as covered. On a grid of 48 by 48 cells, so to about
/// 2 %. O(faces * cells).
[[nodiscard]] double silhouette_share(const mesh::Surface& body, const mesh::Surface& larger, Vec3 direction);

}  // namespace ridgecraft::prepare
