// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that nobody sees. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::prepare {

/// Leaves out the components from which one can't look out, from no place on either side of their faces, the
/// ground open: the furniture of a house that is closed by sheets. Returns how many. Tried are 64 directions
/// from 4 to 64 places of each face, by its size; one look that gets out is enough. Components of more than
/// 1000 faces stay, and so does what wasn't found to be hidden after 20,000 places: three seconds. O(n log n)
/// for n faces.
std::size_t leave_out_unseen(mesh::Model& model, const Context& context);

}  // namespace ridgecraft::prepare
