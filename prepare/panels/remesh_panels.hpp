// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions get along with their corners. Private to prepare/.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// Drops the vertices inside flat regions (panels, divided where the material changes) and those on straight
/// sides that only two regions, or one region and the border, share, and triangulates what is left of each
/// region that lost a vertex by constrained Delaunay. The surface stays the same within 1e-5 of its diagonal;
/// a region where that can't be done safely stays as it is. O(n log n).
void remesh_panels(mesh::Model& model, const Context& context);
/// The same with other regions than those in one plane; `panels` then has the new faces.
void remesh_panels(mesh::Model& model, Panels& panels, const Context& context);

/// Faces with one label become one panel; panels are numbered in the order of their smallest faces. O(n +
/// largest label).
[[nodiscard]] Panels panels_by_label(const std::vector<std::uint32_t>& label);

}  // namespace ridgecraft::prepare
