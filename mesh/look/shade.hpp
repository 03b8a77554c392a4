// SPDX-License-Identifier: GPL-3.0-or-later
// The hollows of a surface as it was read, as colours: what little light from all around comes into is dark.
#pragma once

#include "base/context.hpp"
#include "mesh/look/look.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// All faces of a surface that have an area, in white. O(n).
[[nodiscard]] LookParts white_look(const Surface& surface);

/// Darkens all that has no picture by the share of the light from around that other faces within a tenth of
/// the surface's extent keep from it, to two fifths where none comes in. Faces are divided until their sides
/// are no longer than a fiftieth of the extent. O(parts of faces x log n). Throws Error(interrupted).
void add_shade(LookParts& parts, const Context& context);

}  // namespace ridgecraft::mesh
