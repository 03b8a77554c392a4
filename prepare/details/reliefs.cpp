// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/reliefs.hpp"

#include <algorithm>

#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

/// How far apart components may be that meet, as a share of what is low.
constexpr double hair = 0.02;

}  // namespace

std::vector<bool> are_reliefs(const mesh::Surface& surface, const std::vector<ComponentFaces>& candidates,
                              const std::vector<FaceId>& ground, double height, const Context& context) {
  std::vector<bool> result(candidates.size(), false);
  if (ground.empty()) {
    return result;
  }
  const Neighbours neighbours(surface);
  const mesh::Surface walls = mesh::faces_alone(surface, ground);
  const mesh::SurfaceTree near(walls, walls.bounds().largest_extent());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    context.check();
    const mesh::Surface alone = mesh::faces_alone(surface, candidates[c]);
    const auto is_near = [&](Vec3 p) { return near.distance(p, height) <= height; };
    // Corners alone tell of most bodies that they stand out.
    const bool may_be = std::all_of(alone.points().begin(), alone.points().end(), is_near);
    const auto all_near = [&] {
      const mesh::SurfaceTree places(alone, 0.5 * height);
      return std::all_of(places.samples().begin(), places.samples().end(), is_near);
    };
    result[c] = may_be && all_near() && !neighbours.are_several(candidates[c], hair * height);
  }
  return result;
}

}  // namespace ridgecraft::prepare
