// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow faces along the edges of walls go, and the walls meet in sharp edges. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// A bevel is a flat face with four sides, or with three where it runs out in a tip, narrower than a fold can
/// be short, between two faces that it runs along and that both fold to the same side of it. It goes with
/// both of its ends at once, and so does what lies between the ends of several (the triangle in a bevelled
/// corner): all other faces keep their planes and are extended until they meet. Collapses, edge by edge,
/// would take one end and leave a slanting fold. Bevels stay where the planes around an end have no common
/// point near it, where the surface would move by more than four fifths of `largest_mm`, and in components
/// that can be folded as they are. Panels must have been remeshed; they are again. Returns how many went. O(n
/// log n).
std::size_t sharpen_bevels(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                           const Context& context);

}  // namespace ridgecraft::prepare
