// SPDX-License-Identifier: GPL-3.0-or-later
// Models of cells in layers of different heights.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/elementary.hpp"
#include "mesh/mesh.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

namespace ridgecraft::test {

using PointMap = std::function<Vec3(Vec3)>;

/// Cells of 4 mm in two directions, in layers that end at these heights; panels are remeshed.
inline mesh::Model layers(
    const std::vector<std::array<int, 3>>& cells, const std::vector<double>& heights,
    const PointMap& map = [](Vec3 p) { return p; }) {
  mesh::Soup soup = soup_of(voxels(cells));
  for (Vec3& p : soup.points) {
    p = map({4.0 * p.x, 4.0 * p.y, heights[static_cast<std::size_t>(std::lround(p.z))]});
  }
  mesh::Model model = repaired(soup);
  prepare::remesh_panels(model, {});
  return model;
}

inline Vec3 slanted(Vec3 p) {
  const double c = elementary::cos(0.7);
  const double s = elementary::sin(0.7);
  const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return {q.x, c * q.y - s * q.z, s * q.y + c * q.z};
}

inline Vec3 flipped(Vec3 p) {
  return {-p.x, p.y, p.z};
}

}  // namespace ridgecraft::test
