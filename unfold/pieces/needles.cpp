// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/needles.hpp"

#include <vector>

#include "prepare/prepared/narrow_faces.hpp"

namespace ridgecraft::unfold {

EdgeWishes with_needles_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                             const EdgeWishes& wishes) {
  EdgeWishes result = wishes;
  for (const PanelId p : ids<PanelId>(panels.count())) {
    if (!prepare::is_narrow(surface, panels, p, needle_mm)) {
      continue;
    }
    EdgeId longest;
    for (const FaceId f : panels.faces[p]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const EdgeId e = surface.edge(side);
        const FaceId beyond = surface.neighbor(side);
        const bool free =
            beyond.valid() && panels.panel[beyond] != p && (wishes.empty() || wishes[e] == EdgeWish::none);
        if (free && (!longest.valid() || surface.length(e) > surface.length(longest))) {
          longest = e;
        }
      }
    }
    if (longest.valid()) {
      if (result.empty()) {
        result = EdgeWishes(surface.edge_count(), EdgeWish::none);
      }
      result[longest] = EdgeWish::keep;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
