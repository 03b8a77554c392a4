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

/// Which face is seen in each pixel.
struct CoarseView {
  std::size_t columns = 0;
  std::size_t rows = 0;
  Vec2 low;                  ///< lower left corner of the first pixel, in the scene's unit
  double pixel = 1.0;        ///< side of a pixel
  std::vector<FaceId> face;  ///< row by row from below; none where nothing is

  [[nodiscard]] Vec2 centre(std::size_t i) const {
    return {low.x + pixel * (static_cast<double>(i % columns) + 0.5),
            low.y + pixel * (static_cast<double>(i / columns) + 0.5)};
  }
};

/// Nearest faces by their depth at the middles of the pixels, `across` pixels along the longer side.
[[nodiscard]] CoarseView look_coarsely(const Scene& scene, const Camera& camera, std::size_t across);

/// How much is seen of each of `count` things, square units; thing_of(face) is below count.
template <class ThingOf>
[[nodiscard]] std::vector<double> seen_areas(const CoarseView& view, std::size_t count, ThingOf thing_of) {
  std::vector<double> areas(count, 0.0);
  for (const FaceId face : view.face) {
    if (face.valid()) {
      areas[thing_of(face)] += view.pixel * view.pixel;
    }
  }
  return areas;
}

/// A place well inside what is seen of a thing.
struct Anchor {
  bool seen = false;
  Vec2 at;
  double room = 0.0;  ///< about how far it is from where the thing ends
};

/// Of each of `count` things the place that is farthest from all else.
[[nodiscard]] std::vector<Anchor> find_anchors(const CoarseView& view,
                                               const IdVector<FaceId, std::uint32_t>& thing,
                                               std::size_t count);

/// The same for a word that points at a thing: on the flat region (of Scene::region) of the thing that has
/// the most room, so that it doesn't point at an edge between two.
[[nodiscard]] std::vector<Anchor> find_anchors_on_faces(const CoarseView& view, const Scene& scene,
                                                        const IdVector<FaceId, std::uint32_t>& thing,
                                                        std::size_t count);

/// Where a line to a thing ends: on the face with most room, or, where that is less than `least`, where the
/// thing itself has most.
[[nodiscard]] inline Anchor anchor_to_point_at(const Anchor& on_face, const Anchor& on_thing, double least) {
  return on_face.room >= least ? on_face : on_thing;
}

}  // namespace ridgecraft::export_
