// SPDX-License-Identifier: GPL-3.0-or-later
// What is shallow within a flat wall goes before anything else is simplified. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// Flattens what stands out of a wall or lies behind it by no more than `height_mm`, within a loop of the
/// wall that isn't most of it: panels, frames, flat windows. Of what goes both ways the shallow side goes
/// alone, cut along the wall's plane: the sill and the lintel of a deep window, or the ground that a high
/// knob stands on. Holes through plates go, too, where no place of them is farther than that from the walls
/// and they are no wider than a short edge. Returns how many went. Panels must have been remeshed, and are in
/// the end. O(n log n) for each of a few rounds.
std::size_t trim_reliefs(mesh::Model& model, const SimplifyOptions& options, double height_mm,
                         const Context& context);

}  // namespace ridgecraft::prepare
