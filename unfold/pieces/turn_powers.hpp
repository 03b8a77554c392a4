// SPDX-License-Identifier: GPL-3.0-or-later
// What lies on what after a turn of a model, and after several.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// A power of a model's turn, of two places at least.
struct TurnPower {
  unsigned order = 2;
  IdVector<EdgeId, EdgeId> edge;    ///< the edge that this one lies on after the turn
  IdVector<EdgeId, EdgeId> from;    ///< the edge that lies on this one after the turn
  std::vector<std::uint32_t> unit;  ///< of each unit its image (unit_images)
};

/// Images of images, so often. O(n times).
[[nodiscard]] IdVector<EdgeId, EdgeId> repeated(const IdVector<EdgeId, EdgeId>& images, unsigned times);

/// The turn itself, and those of its powers whose orders divide its own: the finest first. `unit`: units_of.
/// O(n log n) each.
[[nodiscard]] std::vector<TurnPower> powers_of(const prepare::PartialRotation& turn,
                                               const mesh::Surface& surface, const Patch& patch,
                                               std::span<const std::uint32_t> unit);

}  // namespace ridgecraft::unfold
