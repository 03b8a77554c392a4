// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/share.hpp"

namespace ridgecraft::prepare {

std::size_t SymmetricShare::face_count() const {
  std::size_t count = 0;
  for (const auto& face : faces.faces) {
    count += points.copies[face[0]];
  }
  return count - 2 * points.crossings.size();
}

SymmetricShare collapsed(const SymmetricShare& share, std::span<const Collapse> collapses) {
  SymmetricShare result = share;
  result.points.plane = planes_after(share.points, collapses);
  result.faces = replay(share.faces, collapses);
  const std::vector<std::uint32_t> now = points_after(share.faces.points.size(), collapses);
  std::vector<bool> touched(now.size(), false);
  for (const Collapse& c : collapses) {
    touched[c.gone] = touched[c.stays] = true;
  }
  std::erase_if(result.points.crossings, [&](PointRules::Crossing& c) {
    c.end = now[c.end];
    c.image_of_end = now[c.image_of_end];
    return touched[c.point] || result.points.plane[c.end] != PointRules::none ||
           result.points.plane[c.image_of_end] != PointRules::none;
  });
  for (const PointRules::Crossing& c : result.points.crossings) {
    result.faces.points[c.point] =
        crossing(share.points.planes[0], result.faces.points[c.end], result.faces.points[c.image_of_end]);
  }
  return result;
}

}  // namespace ridgecraft::prepare
