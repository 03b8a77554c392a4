// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons become triangles. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/repair_report.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Splits every polygon along diagonals that lie inside it: quads along the one that bends them least (flat
/// ones along the one that gives the better triangles), larger ones by constrained Delaunay in their mean
/// plane. What crosses itself is left out and remarked; what is bent is split and remarked. `flat` is the
/// distance from its mean plane that a corner may have. O(n log n).
[[nodiscard]] TriangleList triangulate(PolygonList list, double flat, RepairReport& report,
                                       const Context& context);

}  // namespace ridgecraft::mesh
