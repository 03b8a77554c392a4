// SPDX-License-Identifier: GPL-3.0-or-later
// A view in large pixels: quick enough to try many, and to find where a word can point to.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "export/view/scene.hpp"

namespace ridgecraft::export_ {

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
