// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a surface as people see them: how much of a model is symmetric is told by these.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// Of each edge its length, in the surface's unit; 0 where it is folded by less than 0.1 degrees, as lines
/// within flat regions are. O(n).
[[nodiscard]] IdVector<EdgeId, double> seen_lengths(const mesh::Surface& surface);

/// Of the seen length of edges what has an image. O(n).
[[nodiscard]] double length_with_image(const IdVector<EdgeId, double>& seen,
                                       const IdVector<EdgeId, EdgeId>& images);

}  // namespace ridgecraft::prepare
