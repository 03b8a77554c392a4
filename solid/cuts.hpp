// SPDX-License-Identifier: GPL-3.0-or-later
// Solids cut by planes. Private to solid/.
#pragma once

#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {

/// What of a solid lies in a half space, closed by caps in its plane. Points of the solid keep their bits,
/// and both sides of a plane have the same points in it. Caps lie where the surface winds around an odd
/// number of times. O(n log n).
[[nodiscard]] Body clipped(const Body& solid, const HalfSpace& half);

/// The connected pieces of a surface, those that share no point; largest first by triangles.
[[nodiscard]] std::vector<Body> pieces_of(const Body& body);

/// Pieces of a solid, by planes that are chosen for the air that hulls lose, until the air that is left in
/// all hulls together is at most `air` of the solid, or there are `most` pieces. Their hulls hold the solid.
[[nodiscard]] std::vector<Body> cut_by_planes(const Body& solid, double air, std::size_t most,
                                              const Context& context);

}  // namespace ridgecraft::solid
