// SPDX-License-Identifier: GPL-3.0-or-later
// Thin walls with a skin on either side become sheets: paper has two sides already. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Leaves one skin of each component at least half as large as the model that has two, no more than `thin`
/// apart (in the unit of the surface) and parallel within 45 degrees: the larger one, with all that sticks
/// out of it farther than that. What goes is the other skin with the rim between them, and no place of that
/// is farther than 1.25 times `thin` from what stays. A component stays as it is where a quarter of its area
/// at least wouldn't go by this. With Skins::middle the skin that stays is moved by half of the wall's
/// thickness at each point. Walls thicker than a twentieth of the model aren't thin, whatever `thin` says.
/// The report's lengths are in the unit of the surface. O(n log n) for n faces, where walls are no narrower
/// than they are thick.
ThinWallReport merge_thin_walls(mesh::Model& model, Skins skins, double thin, const Context& context);

}  // namespace ridgecraft::prepare
