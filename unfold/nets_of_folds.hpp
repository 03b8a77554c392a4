// SPDX-License-Identifier: GPL-3.0-or-later
// Folds of the whole surface become pieces with names, in their order.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Each tree of the folds as a piece: by part, large ones first. Reasons, joins, tabs, holes, fold order and
/// notes are missing. `patch`: whole_patch. O(n log n).
[[nodiscard]] Nets nets_of_folds(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                                 const Patch& patch, const Folds& folds);

}  // namespace ridgecraft::unfold
