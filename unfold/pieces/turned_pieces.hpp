// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that lie around an axis of a model, such as the fins of a rocket, are cut alike.
#pragma once

#include <cstdint>
#include <optional>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// What lies on what by the turn of order three or more, of those that the model has (widest_rotation), that
/// lays most of it on itself. Nothing where none lays a fair part of it there, or images weigh nothing: pairs
/// are told by mirror images. O(n log n).
[[nodiscard]] std::optional<prepare::PartialRotation> turn_of(const mesh::Surface& surface,
                                                              const Weights& weights);

/// Carries pieces over to every place that powers of a turn take them to: each piece that lies on one side of
/// the axis is tried as the one that all others get the net of, and what remains of those joins its
/// neighbours. The trial that costs least is taken (cost_of_forest, with `turn` and `mirrored`) if it costs
/// less than the pieces as they are, until none does. `mirrored`: mirror_images, or empty. Pieces stay clean,
/// and fit the room if they did; there is at most one more by each step. Deterministic for one seed but for
/// the deadline. O(n log n) for each trial, of which there are at most 32 in each of six steps.
[[nodiscard]] Folds turned_pieces(const NetProblem& problem, const Folds& folds,
                                  const prepare::PartialRotation& turn,
                                  const IdVector<EdgeId, EdgeId>& mirrored, const Context& context);

}  // namespace ridgecraft::unfold
