// SPDX-License-Identifier: GPL-3.0-or-later
// Some faces of a surface as a surface of their own.
#pragma once

#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// In the order given, with the points that they use and no others. O(n log n).
[[nodiscard]] Surface faces_alone(const Surface& surface, const std::vector<FaceId>& faces);

}  // namespace ridgecraft::mesh
