// SPDX-License-Identifier: GPL-3.0-or-later
// Star polygons, as of Kepler's and Poinsot's solids. Private to mesh/.
#pragma once

#include "mesh/model/soup.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Flat polygons of five and more corners whose sides cross, and which run around each place the same way or
/// not at all, become the outline of what they run around: crossings are new points, what is within is no
/// side any more. An outline that is seen whole from its middle becomes triangles around that. Other polygons
/// stay as they are. `flat`: as for triangulate(). Counts crossed_polygons_rebuilt. O(corners squared) for
/// each flat polygon of five to 256 corners.
void outline_stars(PolygonList& list, double flat, RepairReport& report);

}  // namespace ridgecraft::mesh
