// SPDX-License-Identifier: GPL-3.0-or-later
// What is looked at: some faces of a surface, as the eye has them before it; and areas in convex pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "export/view/camera.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::export_ {

/// What a closed outline covers, as trapezoids that don't overlap. It may touch itself, as where a slit leads
/// to a hole. Corners are rounded to a ten-millionth of its size. O(n log n) where its edges don't cross.
[[nodiscard]] std::vector<std::vector<Vec2>> trapezoids(const std::vector<Vec2>& outline);

/// Not copied: the surface must outlive it.
struct Scene {
  const mesh::Surface* surface = nullptr;
  /// Of each face: the flat region that it is drawn as a part of; hidden_region where it isn't there at all.
  IdVector<FaceId, std::uint32_t> region;
  /// Edges that are drawn inside the picture; outlines are drawn without being asked for.
  IdVector<EdgeId, bool> drawn;

  static constexpr std::uint32_t hidden_region = 0xffffffffU;
  [[nodiscard]] bool has(FaceId face) const { return region[face] != hidden_region; }
};

/// A face before the eye.
struct SeenFace {
  FaceId face;
  std::array<Vec2, 3> corners;  ///< counterclockwise
  Vec3 depth_plane;             ///< depth at (x, y) is dot of this with (x, y, 1)
  bool inside = false;          ///< its printed side looks away: the eye sees into the model

  [[nodiscard]] double depth_at(Vec2 p) const {
    return depth_plane.x * p.x + depth_plane.y * p.y + depth_plane.z;
  }
  [[nodiscard]] Box2 box() const {
    Box2 result;
    for (const Vec2 corner : corners) {
      result.add(corner);
    }
    return result;
  }
};

/// The faces of a scene that could be seen, were nothing in the way: not those that the eye has edge-on, nor
/// the far side of bodies that are there as a whole and closed. Ascending by face. O(faces).
[[nodiscard]] std::vector<SeenFace> seen_faces(const Scene& scene, const Camera& camera);

/// Size of what is there, as the eye has it.
[[nodiscard]] Box2 seen_box(const Scene& scene, const Camera& camera);

}  // namespace ridgecraft::export_
