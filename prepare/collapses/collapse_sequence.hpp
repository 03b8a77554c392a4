// SPDX-License-Identifier: GPL-3.0-or-later
// Simplification as a sequence of edge collapses that is worked out once and can be stopped anywhere. Private
// to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// What guides and limits the collapses besides the quadric error.
struct CollapseRules {
  double short_edge = 1.0;  ///< folds below are short; the scale of steps at walls
  /// Where given, the surface may not leave this field around the original one, nor move farther from any
  /// part of the original than largest_deviation.
  mesh::NearField* field = nullptr;
  double largest_deviation = 0.0;
  std::size_t faces = 0;  ///< collapses end at so many, counted in the whole
};

/// Collapses by least quadric error (Garland, Heckbert: Surface simplification using quadric error
/// metrics, 1997; CGAL's implementation, with planes weighted by area) down to the number of faces of the
/// rules, or until no collapse is left that keeps the surface manifold without flipping or folding faces.
/// Borders and sharp edges stay by the planes they add. Of a domain of a symmetric whole the errors are those
/// of the whole, and no edge or face comes to lie between points of a plane but its border. Vertices of walls
/// stay in their planes, and no wall vanishes. Faces are counted in the whole. The domain's faces must fulfil
/// mesh::Surface's invariants. O(n log n).
[[nodiscard]] std::vector<Collapse> collapse_sequence(const FundamentalDomain& domain, const Walls& walls,
                                                      const CollapseRules& rules, const Context& context);

}  // namespace ridgecraft::prepare
