// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that aren't one closed solid: holes are closed, components tied together
// (docs/design/segmentation.md, "Damaged models").
#pragma once

#include "mesh/model/surface.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Whether a surface looks damaged: more than a tenth of its edges are borders and it falls into more than 20
/// components.
[[nodiscard]] bool looks_damaged(const mesh::Surface& surface);

/// Joins border vertices at the same place, ties pieces that touch nothing to the nearest larger piece, then
/// closes every hole whose area is at most that of a circle with a perimeter of 2 ball radii: larger ones are
/// openings. New facets have numbers from the old count on; there are no new vertices. O(n log n + sum of
/// squared hole lengths).
void close_holes(ScaledSurface& surface);

// Components that lie apart or run through each other become one object for the segmentation.

/// Ties components together by ribbons of virtual facets: along the shortest tree between their vertices
/// (edges of the Delaunay triangulation, Kruskal's algorithm) a facet's side at one end is opened and joined
/// to one at the other end, by two triangles for each of the two facets there. So the surface stays as closed
/// and oriented as it was and encloses no more; valleys run over the ribbons, and cuts through them cost what
/// they are long. New facets have numbers from the old count on; there are no new vertices. Expected
/// O(n log n).
void tie_components(ScaledSurface& surface);

}  // namespace ridgecraft::segment
