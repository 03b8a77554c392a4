// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_panels.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::test {

prepare::Panels flat_panels(const mesh::Surface& surface) {
  prepare::Panels panels;
  panels.panel.resize(surface.face_count());
  for (const FaceId seed : ids<FaceId>(surface.face_count())) {
    if (panels.panel[seed].valid()) {
      continue;
    }
    const PanelId panel = panels.faces.push_back({seed});
    panels.panel[seed] = panel;
    auto& faces = panels.faces[panel];
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(faces[i], k);
        const FaceId next = surface.neighbor(c);
        if (next.valid() && !panels.panel[next].valid() &&
            std::abs(surface.fold_angle(surface.edge(c))) < 1e-6) {
          panels.panel[next] = panel;
          faces.push_back(next);
        }
      }
    }
    std::sort(faces.begin(), faces.end());
  }
  return panels;
}

}  // namespace ridgecraft::test
