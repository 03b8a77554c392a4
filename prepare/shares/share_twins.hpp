// SPDX-License-Identifier: GPL-3.0-or-later
// Of equal bodies one is simplified, and the others become its copies. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/shares/share.hpp"

namespace ridgecraft::prepare {

/// Takes components that are twins of others out of a share and writes them down as copies; but for such as
/// the mirror plane crosses. `model` is what the share was made of. O(n log n).
void share_twins(SymmetricShare& share, const mesh::Surface& model, const Context& context);

}  // namespace ridgecraft::prepare
