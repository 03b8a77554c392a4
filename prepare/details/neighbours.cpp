// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/neighbours.hpp"

#include "base/boxes.hpp"

namespace ridgecraft::prepare {

Neighbours::Neighbours(const mesh::Surface& surface)
    : surface_(surface),
      tree_(
          surface.face_count(), [&](std::uint32_t f) { return surface.bounds(FaceId(f)); },
          [&](std::uint32_t f) { return centre(surface.bounds(FaceId(f))); }) {}

bool Neighbours::are_several(const ComponentFaces& faces, double reach,
                             const std::function<bool(ComponentId)>& counts) const {
  const ComponentId own = surface_.component(faces.front());
  ComponentId other;
  bool several = false;
  for (const FaceId f : faces) {
    const Box3 box = grown(surface_.bounds(f), reach);
    tree_.search(
        [&](std::uint32_t node) { return !several && meet(box, tree_.box(node)); },
        [&](std::uint32_t at) {
          const FaceId near{tree_.order()[at]};
          const ComponentId c = surface_.component(near);
          if (c == own || c == other || !meet(box, surface_.bounds(near)) || (counts && !counts(c))) {
            return;
          }
          several = several || other.valid();
          other = c;
        });
  }
  return several;
}

}  // namespace ridgecraft::prepare
