// SPDX-License-Identifier: GPL-3.0-or-later
// Turned bodies (columns, wheels, bottles): fewer sides, evenly around. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// A component whose points lie on rings about an axis, equally many (12 or more) and evenly spaced on each,
/// is one that was turned. Where it can't be folded as it is (fold_figures.hpp), or has more faces than
/// anybody builds, its rings become regular polygons of fewer corners, and rings between which its outline
/// hardly bends are left out: the largest number of faces that can be folded, while the surface moves by
/// `largest_mm` at most. Collapses, edge by edge, would leave it lopsided. Components that this doesn't make
/// foldable stay as they are. Returns how many have changed. Faces keep material and object. O(n log n) for
/// each component.
std::size_t simplify_turned(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                            const Context& context);

/// Whether any component is one that was turned. O(n log n).
[[nodiscard]] bool has_turned(const mesh::Model& model);

}  // namespace ridgecraft::prepare
