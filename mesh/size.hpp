// SPDX-License-Identifier: GPL-3.0-or-later
// From the file's unit to millimetres. Private to mesh/.
#pragma once

#include "mesh/mesh.hpp"

namespace ridgecraft::mesh {

/// Moves the bounding box's centre to the origin and scales the points; returns the millimetres of one unit
/// of the file. Throws Error(no_nets) where the result would have no size at all or one that no number of
/// sheets can hold.
double resize(Model& model, const SizeOptions& size);

}  // namespace ridgecraft::mesh
