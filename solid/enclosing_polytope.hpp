// SPDX-License-Identifier: GPL-3.0-or-later
// A convex body of few vertices around a convex body of many. Private to solid/.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "solid/body.hpp"

namespace ridgecraft::solid {

/// A convex body that encloses `hull` and has at most `max_vertices` (at least 8) vertices. It begins as a
/// box, and each further plane touches the hull where it is nearest to the body's farthest corner; of two
/// such bodies, from the box of the axes and from a small one, the one of less volume.
[[nodiscard]] Body enclosing_polytope(const Body& hull, std::size_t max_vertices, const Context& context);

}  // namespace ridgecraft::solid
