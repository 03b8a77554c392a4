// SPDX-License-Identifier: GPL-3.0-or-later
// Equal bodies become copies of one of them, corner by corner and triangle by triangle, so that what is done
// with one can be done with all. Private to prepare/.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/twin_bodies.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {

/// Bodies that are equal but for a motion: the same corners and the same flat regions. Within these the
/// triangles may differ.
struct EqualBodies {
  std::vector<std::vector<FaceId>> bodies;  ///< faces of each component of the surface
  std::vector<std::vector<Twin>> kinds;     ///< indices into it; two or more of each kind
  double farthest = 0.0;  ///< greatest distance of a corner from where it would be, the surface's unit
};

/// Components whose corners lie within `allowed` (the surface's unit) and twin_tolerance of where they would
/// as copies of the first of their kind. O(n log n).
[[nodiscard]] EqualBodies find_equal_bodies(const mesh::Model& model, const Panels& panels, double allowed,
                                            const Context& context);

/// Gives each body but the first of its kind the points and triangles of that one, moved. Faces keep their
/// numbers as a set, and their polygons and materials by where they lie. Linear but for
/// faces that have no partner. What is whose copy then.
TwinBodies make_copies(mesh::Model& model, const EqualBodies& equal);

/// Gives copies the flat regions of the first of their kind. Linear.
void copy_panels(const TwinBodies& twins, Panels& panels);

}  // namespace ridgecraft::prepare
