// SPDX-License-Identifier: GPL-3.0-or-later
// A body that rises from a flat face is glued onto it: no hole is cut there.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::prepare {

/// Parts a surface along each line within a flat face at which something rises from it: a tower on a plate, a
/// chimney on a roof. The face goes on below, and what rises there is a component of its own that is open at
/// its base. Who cuts paper would rather draw an outline on the face and glue the base onto it than cut a
/// hole and glue into that.
///
/// The line is a loop of valley folds that touches neither the face's outline nor another loop, and parts
/// the surface in two; nothing within it lies in the face's plane and looks the same way, as the floor of a
/// well does. Faces that are added are like the face around; all else stays to the last bit. Returns how
/// many components are attached to others: only so many that there are ten in all at most, those with the
/// smallest bases, as more of them would be hard to keep apart on a table. Bases of less than 6 mm^2 stay as
/// they are; the model is in mm. O(n log n), and for each base the faces of the attached body. Throws
/// Error(interrupted).
std::size_t part_attached_bodies(mesh::Model& model, const Context& context);

}  // namespace ridgecraft::prepare
