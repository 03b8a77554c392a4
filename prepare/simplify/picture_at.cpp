// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/picture_at.hpp"

#include <array>

namespace ridgecraft::prepare {

Vec2 picture_at(const mesh::Surface& surface, const mesh::LooseFaces& faces, FaceId f, Vec3 p) {
  const auto [a, b, c] = surface.vertices(f);
  const Vec3 origin = surface.point(a);
  const Vec3 doubled = cross(surface.point(b) - origin, surface.point(c) - origin);
  const std::array<Vec2, 3>& t = faces.texture[f.value()];
  if (doubled == Vec3{}) {
    return t[0];
  }
  const double v = dot(cross(p - origin, surface.point(c) - origin), doubled) / dot(doubled, doubled);
  const double w = dot(cross(surface.point(b) - origin, p - origin), doubled) / dot(doubled, doubled);
  return t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
}

}  // namespace ridgecraft::prepare
