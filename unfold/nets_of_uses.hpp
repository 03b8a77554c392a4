// SPDX-License-Identifier: GPL-3.0-or-later
// Finished nets of which some edges are used otherwise now become nets again.
#pragma once

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {

/// What reasons are found from: each piece that isn't the one that stands for its part was cut off whole.
[[nodiscard]] Causes causes_in(const Nets& nets);

/// The pieces that `changed.use` says, in their order, each face where `changed.flat` has it, without joins,
/// tabs, kinds of equal pieces and notes. Pieces that were there `before` are folded as they were. `wishes`:
/// of each edge, or none. O(n log n) but for the order in which new pieces are folded.
[[nodiscard]] Nets nets_of_uses(const mesh::Surface& surface, const prepare::Panels& panels,
                                const IdVector<FaceId, PartId>& part, const EdgeWishes& wishes,
                                const Nets& before, const Nets& changed, const Causes& causes,
                                const Context& context);

}  // namespace ridgecraft::unfold
