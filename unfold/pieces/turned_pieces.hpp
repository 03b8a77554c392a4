// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that lie around an axis of a model, such as the fins of a rocket, are cut alike.
#pragma once

#include <cstdint>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/piece_rules.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// Carries pieces over to every place that a turn takes them to, when the model has a turn of three
/// (prepare/symmetry/rotations.hpp): each piece that lies on one side of the axis is tried as the one that
/// all others get the net of, and what remains of those joins its neighbours. The trial that costs least is
/// taken (piece_cost.hpp, and Weights::mirror for each mm of cut whose image, turned or mirrored, is none) if
/// it costs less than the pieces as they are, until none does. `mirrored`: mirror_images, or empty. Pieces
/// stay clean (no deeper than `tolerance`, mm), and fit the room if they did; there is at most one more by
/// each step. O(n log n) for each trial, of which there are at most 32 in a step.
[[nodiscard]] Folds turned_pieces(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                                  const IdVector<EdgeId, EdgeId>& mirrored, const Weights& weights,
                                  const Room& room, double tolerance, std::uint64_t seed,
                                  const Context& context);

}  // namespace ridgecraft::unfold
