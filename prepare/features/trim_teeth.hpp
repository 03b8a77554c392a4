// SPDX-License-Identifier: GPL-3.0-or-later
// Battlements, cogs, ribs: what is too low to be folded and stands along the edges of a model. Private to
// prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// A tooth of up to some hundred faces stands beside a flat face (the ground between two merlons), out of its
/// plane by no more than `height_mm`, and is level on top, as far as it covers that plane. Teeth are cut off
/// along the plane where that leaves half of their faces at most. As this changes how a model looks, it is
/// done only where a tenth of all its triangles go by it, and not in models of more than 100,000. Panels must
/// have been remeshed, and are in the end. Returns how many teeth went. O(n log n) for each of a few rounds.
std::size_t trim_teeth(mesh::Model& model, const SimplifyOptions& options, double height_mm,
                       const Context& context);

}  // namespace ridgecraft::prepare
