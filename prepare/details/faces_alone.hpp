// SPDX-License-Identifier: GPL-3.0-or-later
// Some faces of a surface as a surface of their own. Private to prepare/.
#pragma once

#include <vector>

#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// In the order given, with the points that they use and no others. O(n log n).
[[nodiscard]] mesh::Surface faces_alone(const mesh::Surface& surface, const std::vector<FaceId>& faces);

}  // namespace ridgecraft::prepare
