// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer and wider faces side by side along what is bent one way: columns, arches, vaults, rounded corners.
// Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// Takes lines of rulings (prepare/panels/ruled_strips.hpp) out of strips whose faces are narrower than a
/// fold is long: both ends of a ruling at once, so that the faces between those that stay are flat and what
/// the strip ends at keeps its plane. Collapses, edge by edge, would leave a slanting fold in each of them.
/// Which lines stay is what costs least by how far the surface moves and how narrow faces are left (dynamic
/// programming along the strip), a mirror image of itself where the strip is one. Sides of a body that was
/// made with few, such as an octagonal tower, stay. Components that can be folded as they are stay, too.
/// `largest_mm`: how far the surface may move. Panels must have been remeshed; they are again. Returns how
/// many lines went. Near-linear.
std::size_t thin_rulings(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                         const Context& context);

}  // namespace ridgecraft::prepare
