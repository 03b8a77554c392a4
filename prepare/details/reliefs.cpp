// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/reliefs.hpp"

#include <algorithm>

#include "base/box_tree.hpp"
#include "base/boxes.hpp"
#include "mesh/model/faces_alone.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

/// How far apart components may be that meet, as a share of what is low.
constexpr double hair = 0.02;

/// Finds what else is where a component is.
class Neighbours {
 public:
  explicit Neighbours(const mesh::Surface& surface)
      : surface_(surface),
        tree_(
            surface.face_count(), [&](std::uint32_t f) { return box_of(FaceId(f)); },
            [&](std::uint32_t f) { return centre(box_of(FaceId(f))); }) {}

  /// Do faces of two other components, or of more, come as near as `reach`?
  [[nodiscard]] bool are_several(const ComponentFaces& faces, double reach) const {
    const ComponentId own = surface_.component(faces.front());
    ComponentId other;
    bool several = false;
    for (const FaceId f : faces) {
      const Box3 box = grown(box_of(f), reach);
      tree_.search([&](std::uint32_t node) { return !several && meet(box, tree_.box(node)); },
                   [&](std::uint32_t at) {
                     const FaceId near{tree_.order()[at]};
                     const ComponentId c = surface_.component(near);
                     if (c == own || c == other || !meet(box, box_of(near))) {
                       return;
                     }
                     several = several || other.valid();
                     other = c;
                   });
    }
    return several;
  }

 private:
  [[nodiscard]] Box3 box_of(FaceId f) const {
    Box3 box;
    for (const VertexId v : surface_.vertices(f)) {
      box.add(surface_.point(v));
    }
    return box;
  }

  const mesh::Surface& surface_;
  BoxTree<Box3> tree_;
};

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
