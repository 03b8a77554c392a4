// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions get along with their corners. Private to mesh/.
#pragma once

#include "mesh/context.hpp"
#include "mesh/model.hpp"

namespace ridgecraft::mesh {

/// Drops the vertices inside flat regions (panels, divided where the material changes) and those on straight
/// sides that only two regions, or one region and the border, share, and triangulates what is left of each
/// region that lost a vertex by constrained Delaunay. The surface stays the same within 1e-5 of its diagonal;
/// a region where that can't be done safely stays as it is. Models with textures stay as they are where a
/// region's picture isn't laid on it by one affine map. O(n log n).
void remesh_panels(Model& model, const Context& context);

}  // namespace ridgecraft::mesh
