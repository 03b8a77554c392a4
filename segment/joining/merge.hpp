// SPDX-License-Identifier: GPL-3.0-or-later
// The merge pass: neighbours whose union is within the tolerance become one part
// (docs/design/segmentation.md, "Merge pass").
#pragma once

#include <cstdint>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/cutting/edge_weights.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// A part on its way through the merge pass.
struct MergePart {
  Facets facets;
  std::vector<std::uint32_t> hull_vertices;  ///< not looked at from scratch
  bool merged = false;                       ///< made of several
  bool open = true;                          ///< pairs of which neither is open are left as they are
};

/// Joins pairs of parts with a common edge, convex borders first, until no union of two is within the
/// tolerance, measured from scratch or with the hull of the two parts' hull vertices and all that is known.
/// Parts that went into another are left without facets. At most n - 1 merges; a pair is tested again only
/// when one of the two has changed.
void merge_parts(Measurer& measurer, const EdgeWeights& weights, std::vector<MergePart>& parts,
                 bool from_scratch);

}  // namespace ridgecraft::segment
