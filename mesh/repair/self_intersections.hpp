// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that run through each other. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// More faces are not looked at: it would take longer than everything else.
inline constexpr std::size_t most_faces_for_self_intersections = 20000;

/// Number of pairs of faces that meet without having a corner at one place (CGAL, exact): those that have may
/// touch there only, as they do where an edge with more than two faces was cut open. 0 for surfaces with more
/// faces than the limit. Throws Error(interrupted).
[[nodiscard]] std::size_t count_self_intersections(const Surface& surface, const Context& context);

}  // namespace ridgecraft::mesh
