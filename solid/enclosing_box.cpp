// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/enclosing_box.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ridgecraft::solid {
namespace {

/// More of the hull's triangles as sides hardly make the box smaller.
constexpr std::size_t most_sides = 128;
/// A box must be smaller by this share to be preferred: boxes along the coordinate axes stay so.
constexpr double saving = 1e-9;

Box box_along(const std::array<Vec3, 3>& axes, const Body& hull) {
  Box box{axes, {}};
  for (const Vec3 p : hull.points) {
    box.along.add({dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
  }
  return box;
}

Vec3 doubled_area(const Body& hull, const std::array<std::uint32_t, 3>& t) {
  return cross(hull.points[t[1]] - hull.points[t[0]], hull.points[t[2]] - hull.points[t[0]]);
}

}  // namespace

Vec3 Box::corner(unsigned i) const {
  const double x = (i & 1U) != 0 ? along.high.x : along.low.x;
  const double y = (i & 2U) != 0 ? along.high.y : along.low.y;
  const double z = (i & 4U) != 0 ? along.high.z : along.low.z;
  return x * axes[0] + y * axes[1] + z * axes[2];
}

double Box::volume() const {
  const Vec3 size = along.size();
  return size.x * size.y * size.z;
}

Box box_along_axes(const Body& hull) {
  return box_along({Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}, hull);
}

Box smallest_box(const Body& hull) {
  Box best = box_along_axes(hull);
  std::vector<std::size_t> order(hull.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> area;
  for (const auto& t : hull.triangles) {
    area.push_back(length(doubled_area(hull, t)));
  }
  const std::size_t sides = std::min(most_sides, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(sides), order.end(),
      [&](std::size_t a, std::size_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
  for (std::size_t i = 0; i < sides; ++i) {
    const auto& t = hull.triangles[order[i]];
    const Vec3 normal = normalized(doubled_area(hull, t));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = normalized(hull.points[t[(k + 1) % 3]] - hull.points[t[k]]);
      if (normal == Vec3{} || edge == Vec3{}) {
        continue;
      }
      const Box box = box_along({edge, normalized(cross(normal, edge)), normal}, hull);
      if (box.volume() < (1.0 - saving) * best.volume()) {
        best = box;
      }
    }
  }
  return best;
}

}  // namespace ridgecraft::solid
