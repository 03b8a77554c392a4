// SPDX-License-Identifier: GPL-3.0-or-later
// Folds of the whole surface become pieces with names, in their order.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

/// Each tree of the folds as a piece: by part, large ones first, each with the reason that most of its faces
/// have in `causes`. Joins, tabs, holes, fold order and notes are missing. `patch`: whole_patch. O(n log n).
[[nodiscard]] Nets nets_of_folds(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                                 const Patch& patch, const Folds& folds, const Causes& causes);

/// The pieces that were split off others, but for the largest of each, are there for this reason. Their
/// number. `before`, `after`: folds of whole_patch. O(n log n).
std::size_t blame(const Patch& patch, const Folds& before, const Folds& after, PieceReason reason,
                  Causes& causes);

}  // namespace ridgecraft::unfold
