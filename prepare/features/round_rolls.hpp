// SPDX-License-Identifier: GPL-3.0-or-later
// Bands that are rolled get as many rulings as make them round. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// The regions of bands that are rolled (find_rolls) are divided by further rulings, and their rims become
/// arcs through their corners, until each side of a rim is 0.2 mm off its arc at most, or would be shorter
/// than the short edge. What lies beside a rim gets its corners, too: flat regions must lie in the arc's
/// plane. Regions whose parts would not be flat, and what shares a rim with them, stay. Models are in mm, and
/// a straight fold between two panels is one edge (remesh_panels). Returns how many rulings there are more.
/// O(n log n).
std::size_t round_rolls(mesh::Model& model, const SimplifyOptions& options, const Context& context);

}  // namespace ridgecraft::prepare
