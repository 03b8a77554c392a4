// SPDX-License-Identifier: GPL-3.0-or-later
// Which way the folds of a piece run: paper folds cleanly along its grain, and cracks across it.
#pragma once

#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Of each piece the direction that its folds have most in common, on its net: the axis of the mean of their
/// doubled angles, each by its length times its fold angle. A unit vector, of either sense; zero where no
/// direction is before others. O(edges).
[[nodiscard]] IdVector<PieceId, Vec2> fold_directions(const mesh::Surface& surface, const unfold::Nets& nets);

/// Pieces whose folds don't run along the grain of their sheet, within 15 degrees: those that fit it no other
/// way. None where the paper's grain isn't to be heeded. O(pieces).
[[nodiscard]] std::vector<PieceId> pieces_off_grain(const IdVector<PieceId, Vec2>& directions,
                                                    const Pages& pages);

/// How far from the grain's direction folds may run, degrees: it still bends them, and the packer has a
/// choice.
inline constexpr double grain_tolerance_degrees = 15.0;
/// Which way the grain runs on a sheet. A unit vector.
[[nodiscard]] Vec2 grain_direction(const Paper& paper);

}  // namespace ridgecraft::export_
