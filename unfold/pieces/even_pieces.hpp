// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of a symmetric model that are each other's mirror images, or their own, where they weren't.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {

/// Carries the pieces of one side of the mirror plane over to the other: those that a fold joins across the
/// plane become their own mirror image, of the others each gets one. Both sides are tried; the one that costs
/// less (piece_cost.hpp, and Weights::mirror for each mm of cut whose mirror image is none) is taken if it
/// makes no more pieces and costs no more than the forest as it was, every piece has a net without overlap
/// and those that fitted the room do. Faces without a mirror image stay with
/// what they were with. Deterministic for one seed but for the deadline. O(n
/// log n) beside the search for nets of the pieces that change. `turned`: the edges' images by a turn of the
/// model, or empty: cuts that have none there cost the same.
[[nodiscard]] Folds even_pieces(const NetProblem& problem, const Folds& folds, const MirrorImages& images,
                                const IdVector<EdgeId, EdgeId>& turned, const Context& context);

}  // namespace ridgecraft::unfold
