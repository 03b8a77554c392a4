// SPDX-License-Identifier: GPL-3.0-or-later
// Turns that lay a surface on itself, or most of it: petals, spokes, towers, fins.
#pragma once

#include <optional>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// A turn that lays much of a surface on itself, whatever else stands on it: a rocket's four fins beside its
/// one door.
struct PartialRotation {
  unsigned order = 2;             ///< the turn is one of so many of a full circle
  IdVector<EdgeId, EdgeId> edge;  ///< of each edge the one that its image lies on (match_edges)
};

/// Of the turns about lines through the middle of the surface's box or area, along an axis of coordinates or
/// a principal axis of the area, the one of at least this order that lays the greatest length of edges on
/// edges; of lengths that differ by less than 5 % that of the highest order. Edges within flat regions don't
/// count. Nothing where no turn lays `least_share` of the length on edges. `near`: how far ends may be off, a
/// share of the extent. O(n log n).
[[nodiscard]] std::optional<PartialRotation> widest_rotation(const mesh::Surface& surface, double near,
                                                             double least_share, unsigned least_order);

}  // namespace ridgecraft::prepare
