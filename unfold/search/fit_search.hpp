// SPDX-License-Identifier: GPL-3.0-or-later
// A net without overlap changes its shape until it fits the sheet.
#pragma once

#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// How far a convex polygon sticks out of a sheet, mm: width and height together, at the best of the turns
/// that lay one of its sides along a side of the sheet. 0: it fits. O(m^2), m corners.
[[nodiscard]] double excess(std::span<const Vec2> hull, const Sheet& sheet);

/// Hangs branches that stick out of the sheet elsewhere, never making an overlap deeper than the tolerance
/// (mm), until the net fits the room or `trials` are spent. `folds`: a spanning tree without overlap. Returns
/// a tree without overlap that sticks out no further; panels stay whole. About 0.05 ms a trial at 100 faces.
[[nodiscard]] Folds shrink_to_fit(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                  std::uint64_t trials, std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
