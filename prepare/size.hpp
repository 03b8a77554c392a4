// SPDX-License-Identifier: GPL-3.0-or-later
// From the file's unit to millimetres. Private to prepare/.
#pragma once

#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// Moves the bounding box's centre to the origin and scales the points; returns the millimetres of one unit
/// of the file. Throws Error(no_nets) where the result would have no size at all or one that no number of
/// sheets can hold.
double resize(mesh::Model& model, const SizeOptions& size);

}  // namespace ridgecraft::prepare
