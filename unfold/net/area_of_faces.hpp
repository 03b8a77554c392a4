// SPDX-License-Identifier: GPL-3.0-or-later
// How much paper some faces take.
#pragma once

#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::unfold {

/// In the surface's unit squared. Linear.
[[nodiscard]] inline double area_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    area += surface.area(f);
  }
  return area;
}

}  // namespace ridgecraft::unfold
