// SPDX-License-Identifier: GPL-3.0-or-later
// Holes of damaged surfaces are closed with facets that take part in everything but the result
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

}  // namespace ridgecraft::segment
