// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/collapse.hpp"

#include <array>

namespace ridgecraft::prepare {

Vec3 crossing(const MirrorPlane& plane, Vec3 end, Vec3 image_of_end) {
  const double height = plane.height(end);
  const double sum = height + plane.height(image_of_end);
  const double share = sum > 0.0 || sum < 0.0 ? height / sum : 0.0;
  return plane.foot(end + share * (plane.image(image_of_end) - end));
}

std::vector<std::uint32_t> points_after(std::size_t count, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> now(count);
  for (std::uint32_t v = 0; v < now.size(); ++v) {
    now[v] = v;
  }
  // A vertex that stayed may be gone later: from the last collapse back, each points to where it ended.
  for (std::size_t i = collapses.size(); i-- > 0;) {
    now[collapses[i].gone] = now[collapses[i].stays];
  }
  return now;
}

std::vector<std::uint32_t> planes_after(const PointRules& points, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> plane = points.plane;
  for (const Collapse& c : collapses) {
    if (plane[c.gone] != PointRules::none) {
      plane[c.stays] = plane[c.gone];
    }
  }
  return plane;
}

mesh::LooseFaces replay(const mesh::LooseFaces& loose, std::span<const Collapse> collapses) {
  mesh::LooseFaces result;
  result.points = loose.points;
  const std::vector<std::uint32_t> now = points_after(loose.points.size(), collapses);
  std::vector<bool> moved(loose.points.size(), false);
  for (const Collapse& c : collapses) {
    result.points[c.stays] = c.place;
    moved[c.gone] = moved[c.stays] = true;
  }
  for (std::size_t f = 0; f < loose.faces.size(); ++f) {
    const auto& [a, b, c] = loose.faces[f];
    const std::array<std::uint32_t, 3> face{now[a], now[b], now[c]};
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
      result.add(loose, f, face);
      if (moved[a] || moved[b] || moved[c]) {
        result.polygon.back() = mesh::Soup::none;
      }
    }
  }
  return result;
}

}  // namespace ridgecraft::prepare
