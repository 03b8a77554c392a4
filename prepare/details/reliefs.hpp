// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that hardly stand out of others. Private to prepare/.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/details/neighbours.hpp"

namespace ridgecraft::prepare {

/// Which of the `candidates` lie on the `ground` all over: no place of them is farther from its faces than
/// `height`, in the unit of the surface, inside it or outside. A window frame in a wall is such a relief. One
/// that meets several components may be what holds them together, and is none; whether they meet is told by
/// the boxes of their faces. O((n + m) log n) for n faces and m places, half of `height` apart.
[[nodiscard]] std::vector<bool> are_reliefs(const mesh::Surface& surface,
                                            const std::vector<ComponentFaces>& candidates,
                                            const std::vector<FaceId>& ground, double height,
                                            const Context& context);

}  // namespace ridgecraft::prepare
