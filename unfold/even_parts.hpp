// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a symmetric model that are each other's mirror images, or their own.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// Carries the parts of one side of a mirror plane over to the other, of that side which makes fewer parts:
/// those that lie on both sides become their own mirror image, of the others each gets one. So left and right
/// are cut alike. The parts as they were where the model has no such plane or mirror images weigh nothing.
/// Parts stay connected and end at the borders of flat regions; they are numbered in the order of their first
/// faces. O(n log n).
[[nodiscard]] IdVector<FaceId, PartId> even_parts(const mesh::Surface& surface, const prepare::Panels& panels,
                                                  IdVector<FaceId, PartId> part, const Weights& weights);

}  // namespace ridgecraft::unfold
