// SPDX-License-Identifier: GPL-3.0-or-later
// Components that lie apart or run through each other become one object for the segmentation.
#pragma once

#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Ties components together by ribbons of virtual facets: along the shortest tree between their vertices
/// (edges of the Delaunay triangulation, Kruskal's algorithm) a facet's side at one end is opened and joined
/// to one at the other end, by two triangles for each of the two facets there. So the surface stays as closed
/// and oriented as it was and encloses no more; valleys run over the ribbons, and cuts through them cost what
/// they are long. New facets have numbers from the old count on; there are no new vertices. Expected
/// O(n log n).
void tie_components(ScaledSurface& surface);

}  // namespace ridgecraft::segment
