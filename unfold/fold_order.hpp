// SPDX-License-Identifier: GPL-3.0-or-later
// Can a piece be folded up without running through itself, and in which order? Self-folding sheets can't help
// themselves with a finger, and makers like to know before they glue.
#pragma once

#include "mesh/context.hpp"
#include "mesh/surface.hpp"
#include "unfold/nets.hpp"

namespace ridgecraft::unfold {

/// The first of these ways in which no two faces of the piece meet, found by sampled motion: all creases at a
/// time, growing alike; one after the other, the outermost first; one after the other from the middle. Faces
/// that meet in the folded piece, too, belong to a model that runs through itself and don't count. Where each
/// way fails it is `with_care`, in the second order. Single creases are tried for pieces up to about 250 flat
/// regions, since the cost is their number squared; one way for all takes O(n log n) for n faces. Tabs are
/// not looked at. Deterministic.
[[nodiscard]] FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                                        const Context& context);

}  // namespace ridgecraft::unfold
