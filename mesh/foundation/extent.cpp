// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/foundation/extent.hpp"

#include <algorithm>

namespace ridgecraft::mesh {

double largest_extent(const Box3& box) {
  const Vec3 size = box.size();
  return std::max({size.x, size.y, size.z});
}

double total_area(const Surface& surface) {
  double area = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area += surface.area(f);
  }
  return area;
}

}  // namespace ridgecraft::mesh
