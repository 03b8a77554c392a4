// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/picture_map.hpp"

#include <algorithm>

namespace ridgecraft::prepare {
namespace {

/// Texture coordinates agree with one affine map within this (a fortieth of a pixel of a 256-pixel picture).
constexpr double same_texture = 1e-4;

}  // namespace

std::optional<PictureMap> picture_map(const mesh::LooseFaces& loose, const std::vector<std::uint32_t>& faces,
                                      const PlaneFrame& frame) {
  if (loose.texture.empty()) {
    return std::nullopt;
  }
  const auto corner_of = [&](std::uint32_t f, std::size_t k) {
    return frame.flat(loose.points[loose.faces[f][k]]);
  };
  const auto doubled_area = [&](std::uint32_t f) {
    const auto& [a, b, c] = loose.faces[f];
    return length(cross(loose.points[b] - loose.points[a], loose.points[c] - loose.points[a]));
  };
  const std::uint32_t widest =
      *std::max_element(faces.begin(), faces.end(),
                        [&](std::uint32_t f, std::uint32_t g) { return doubled_area(f) < doubled_area(g); });
  const Vec2 p = corner_of(widest, 0);
  const Vec2 q = corner_of(widest, 1) - p;
  const Vec2 r = corner_of(widest, 2) - p;
  const double area = cross(q, r);
  if (!(area > 0.0)) {
    return std::nullopt;
  }
  const auto& t = loose.texture[widest];
  PictureMap map;
  map.across = (r.y * (t[1] - t[0]) - q.y * (t[2] - t[0])) / area;
  map.up = (q.x * (t[2] - t[0]) - r.x * (t[1] - t[0])) / area;
  map.origin = t[0] - p.x * map.across - p.y * map.up;
  for (const std::uint32_t f : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(length(map(corner_of(f, k)) - loose.texture[f][k]) < same_texture)) {
        return std::nullopt;
      }
    }
  }
  return map;
}

}  // namespace ridgecraft::prepare
