// SPDX-License-Identifier: GPL-3.0-or-later
// What lies around an axis within a piece, such as the brackets below a gallery, is cut alike.
#pragma once

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "unfold/net/piece_rules.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// Carries branches of pieces over to the places of the same piece that powers of a turn take them to. A
/// branch is what falls off a piece where one fold is cut. The largest of each piece are tried as the ones
/// that their images get the net of; what hung on these hangs where it did, or where else it was folded. Of
/// all trials the one that costs least is taken (cost_of_forest, with `turn` and `mirrored`) if it costs less
/// than the pieces as they are; at most eight are. `mirrored`: mirror_images, or empty. Pieces keep their
/// faces, stay clean (no deeper than `tolerance`, mm), and fit the room if they did. The patch is the whole
/// surface. Deterministic but for the deadline. O(n log n) for each trial, of which each piece has at most 32
/// in each step. Throws Error(interrupted).
[[nodiscard]] Folds turned_branches(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                                    const prepare::PartialRotation& turn,
                                    const IdVector<EdgeId, EdgeId>& mirrored, const Weights& weights,
                                    const Room& room, double tolerance, const Context& context);

}  // namespace ridgecraft::unfold
