// SPDX-License-Identifier: GPL-3.0-or-later
// Where the area of a surface lies. It doesn't depend on how the surface is divided into triangles.
#pragma once

#include <array>

#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

struct AreaFrame {
  Vec3 centre;
  std::array<Vec3, 3> axes;  ///< principal ones, the spread along them ascending
};

/// Linear.
[[nodiscard]] AreaFrame area_frame(const mesh::Surface& surface);

}  // namespace ridgecraft::prepare
