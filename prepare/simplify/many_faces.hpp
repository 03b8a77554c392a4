// SPDX-License-Identifier: GPL-3.0-or-later
// How many faces are so many that the surface needs no care while they become fewer. Private to prepare/.
#pragma once

#include <cstddef>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::prepare {

/// Nothing recognisable is left of a body below this many faces: a box.
inline constexpr std::size_t fewest_faces = 12;
/// Of bodies of more faces flat regions aren't remeshed, and the first collapses are made many at a time, ...
inline constexpr std::size_t very_many_faces = 100000;
/// ... down to this multiple of what needs no care.
inline constexpr std::size_t quick = 4;
/// They may move the surface by this share of what it may move.
inline constexpr double quick_share = 0.1;

/// Down to so many faces of a surface in mm no care is needed: three times those that edges as long as the
/// short one would give. Linear.
[[nodiscard]] std::size_t careless_faces(const mesh::Surface& surface, double short_edge_mm);

}  // namespace ridgecraft::prepare
