// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes with one mirror plane, x = 0.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

namespace ridgecraft::test {

/// The half at x > 0 and its mirror image.
inline mesh::Surface doubled(const mesh::Surface& surface) {
  mesh::Soup soup;
  const auto add = [&](std::array<Vec3, 3> corners) {
    for (const Vec3 p : corners) {
      soup.corner_point.push_back(static_cast<std::uint32_t>(soup.points.size()));
      soup.points.push_back(p);
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  };
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    std::array<Vec3, 3> p;
    for (unsigned k = 0; k < 3; ++k) {
      p[k] = surface.point(surface.vertex(mesh::corner(f, k)));
      p[k].x = std::abs(p[k].x) < 1e-9 ? 0.0 : p[k].x;
    }
    if (p[0].x + p[1].x + p[2].x > 0.0) {
      add(p);
      add({Vec3{-p[0].x, p[0].y, p[0].z}, Vec3{-p[2].x, p[2].y, p[2].z}, Vec3{-p[1].x, p[1].y, p[1].z}});
    }
  }
  return repaired(std::move(soup)).surface;
}

/// A body without any symmetry but that of x.
inline mesh::Surface one_plane(int steps = 24) {
  return mapped(doubled(sphere(steps, 14)), [](Vec3 p) {
    return Vec3{p.x * (1.0 + 0.3 * p.z), 1.7 * p.y + 0.3 * p.z * p.z, p.z + 0.2 * p.y * p.y};
  });
}

}  // namespace ridgecraft::test
