// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing hangs in the air: what becomes of bodies whose hold was left out. Private to prepare/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// Bodies are glued over gaps up to this, mm.
inline constexpr double holding_mm = 1.2;

/// How bodies that lost their hold find another one, in the unit of the surface.
struct HoldRules {
  double touching = 0.0;    ///< bodies no farther apart hold each other
  double most_moved = 0.0;  ///< bodies within this of another one are moved to it
};

/// Bodies that touched each other on `before`, directly or by others between, and don't any more, lost what
/// held them: all but the largest of those that still touch. Each moves onto the nearest body where that is
/// no farther than the rules say. Else it is left out, where it has no more than a twentieth of the area.
/// Returns how many components are left out. O(n log n), and the pairs of faces that are near each other.
/// Throws Error(interrupted), Error(out_of_time).
std::size_t hold_again(mesh::Model& model, const mesh::Surface& before, const HoldRules& rules,
                       const Context& context);

/// Leaves out bodies of a two-hundredth of the area and less that nothing can be glued to: no face of another
/// body, or what closes its flat opening, is near and less than 75 degrees steeper. None where they have a
/// fiftieth of the area together. Returns how many components are left out. As fast as hold_again.
std::size_t leave_out_crumbs(mesh::Model& model, double touching, const Context& context);

}  // namespace ridgecraft::prepare
