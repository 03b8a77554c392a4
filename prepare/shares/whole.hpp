// SPDX-License-Identifier: GPL-3.0-or-later
// From a share back to the whole model. Private to prepare/.
#pragma once

#include "mesh/repair/loose_faces.hpp"
#include "prepare/shares/share.hpp"

namespace ridgecraft::prepare {

/// All faces that a share stands for, with the model's own materials and polygons. What lies on one side of a
/// plane has its mirror image, with mirrored coordinates exactly, on the other. Points of the cut are gone
/// where the faces across it are flat. O(n log n).
[[nodiscard]] mesh::LooseFaces whole(const SymmetricShare& share, const mesh::LooseFaces& model);

}  // namespace ridgecraft::prepare
