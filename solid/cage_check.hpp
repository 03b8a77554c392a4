// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a cage that somebody brings can hold a model: closed, and around it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/context.hpp"
#include "solid/body.hpp"

namespace ridgecraft::solid {

/// Throws Error(unusable_mesh) with a sentence that names the file and the first place, unless each edge of
/// the cage lies between two triangles that run along it in opposite directions. Points in one place count as
/// one, since many formats write each triangle with points of its own. O(n log n).
void require_closed(const std::string& file, const solid::Body& cage);

/// How many of the points lie outside a closed cage; on it is not outside. Winding numbers from solid angles
/// (van Oosterom, Strackee, "The solid angle of a plane triangle", IEEE Transactions on Biomedical
/// Engineering 30(2), 1983), so bodies of one cage may overlap. O(points * cage faces), as the deformation
/// itself.
[[nodiscard]] std::size_t count_outside(std::span<const Vec3> points, const solid::Body& cage,
                                        const Context& context);

}  // namespace ridgecraft::solid
