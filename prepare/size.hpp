// SPDX-License-Identifier: GPL-3.0-or-later
// From the file's unit to millimetres. Private to prepare/.
#pragma once

#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// How a model was brought to its size: a point p of it is now factor * (p - centre).
struct Resized {
  double mm_per_unit = 1.0;  ///< of the file
  double factor = 1.0;
  Vec3 centre;
};

/// Moves the bounding box's centre to the origin and scales the points. Throws Error(no_nets) where the
/// result would have no size at all or one that no number of sheets can hold.
Resized resize(mesh::Model& model, const SizeOptions& size);

}  // namespace ridgecraft::prepare
