// SPDX-License-Identifier: GPL-3.0-or-later
// Folds whose ends nearly lie on another fold: such slivers go by turning an edge. Private to prepare/.
#pragma once

#include <cstddef>

#include "prepare/domains/domain.hpp"

namespace ridgecraft::prepare {

/// A sliver is a face of a flat region narrower than `width_mm`, with one corner close to its longest side
/// (the "cap" of M. Botsch, L. Kobbelt, A robust procedure to eliminate degenerate faces from
/// triangle meshes, 2001). It has no short side, so no collapse takes it away. Here its longest side is
/// replaced by the edge from that corner to the opposite one of the neighbour, which bends by the width of
/// the sliver. That is done where fewer slivers are left and neither the neighbour turns nor a fold
/// becomes a crease; the surface moves by less than `width_mm`. Points stay, so mirror images and copies
/// remain what they are. Returns how many edges were turned, those of mirror images and copies counted, too.
/// O(n log n) for a few rounds.
std::size_t remove_slivers(FundamentalDomain& domain, double width_mm);

}  // namespace ridgecraft::prepare
