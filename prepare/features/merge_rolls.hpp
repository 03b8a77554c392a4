// SPDX-License-Identifier: GPL-3.0-or-later
// Bands that stand on each other become fewer. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// What is round both ways, such as a ball or a bowl, may be a stack of bands that go all the way round
/// (find_rolls), ring on ring. As many of the rings go as can while the surface moves by no more than half of
/// what it may, bends between bands stay below those of creases, and the new regions are flat (dynamic
/// programming along the stack): fewer pieces and seams. Models are in mm, and a straight fold between two
/// panels is one edge (remesh_panels), as after it. Returns how many rings went. O(n m) for n corners in
/// stacks of m bands.
std::size_t merge_rolls(mesh::Model& model, const SimplifyOptions& options, const Context& context);

}  // namespace ridgecraft::prepare
