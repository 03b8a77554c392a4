// SPDX-License-Identifier: GPL-3.0-or-later
// The file's polygons without what can't be a face: repeated corners, too few corners, second copies. Private
// to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

/// Drops corners that repeat the one before them and polygons that are left with fewer than three different
/// points.
void drop_repeated_corners(PolygonList& list, RepairReport& report);

/// Drops both copies of walls between solids: polygons that are there twice, once in either direction, where
/// what else lies at the rim of such walls then closes (as many sides run one way as the other). Of what
/// stays it keeps the first of several polygons with the same corners in the same or the opposite order. Only
/// a triangle or quad whose reversed copy is all that it shares its sides with keeps one such copy: the two
/// are a closed surface, front and back. O(n log n).
void drop_duplicates(PolygonList& list, RepairReport& report);

/// The same for triangles, in place.
void drop_duplicates(TriangleList& list, RepairReport& report);

}  // namespace ridgecraft::mesh
