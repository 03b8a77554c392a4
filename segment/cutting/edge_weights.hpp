// SPDX-License-Identifier: GPL-3.0-or-later
// What a cut along an edge costs: concave and short edges are cheap (docs/segmentation.md,
// "Price of an edge").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/parts/rules.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Per side, 3 f + k, of both facets of an edge alike; 0 at borders.
struct EdgeWeights {
  std::vector<double> length;
  std::vector<double> smoothness;      ///< Theta: small on concave edges, 1 elsewhere
  std::vector<std::int64_t> capacity;  ///< w(e) in steps of 2^-20, at least 1: flows are exact in integers
};

/// `label`, as in segment(): edges between faces of different labels are cheap, too. O(n).
[[nodiscard]] EdgeWeights weigh_edges(const ScaledSurface& surface, const Rules& rules = {},
                                      std::span<const std::uint32_t> label = {});

}  // namespace ridgecraft::segment
