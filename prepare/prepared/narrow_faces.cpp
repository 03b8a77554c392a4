// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/narrow_faces.hpp"

#include <algorithm>

namespace ridgecraft::prepare {
namespace {

double side_length(const mesh::Surface& surface, FaceId f, unsigned k) {
  return surface.length(surface.edge(mesh::corner(f, k)));
}

}  // namespace

bool is_narrow(const mesh::Surface& surface, const Panels& panels, PanelId panel, double width) {
  double area = 0.0;
  double longest = 0.0;
  double highest = 0.0;
  for (const FaceId f : panels.faces[panel]) {
    double side = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      side = std::max(side, side_length(surface, f, k));
    }
    highest = std::max(highest, side > 0.0 ? 2.0 * surface.area(f) / side : 0.0);
    longest = std::max(longest, side);
    area += surface.area(f);
  }
  // Faces side by side may be narrow each and wide together.
  return highest < width && area < width * longest;
}

bool is_sliver(const mesh::Surface& surface, const Panels& panels, PanelId panel) {
  return is_narrow(surface, panels, panel, sliver_mm) && !is_narrow(surface, panels, panel, narrow_mm);
}

std::size_t count_slivers(const mesh::Surface& surface, const Panels& panels) {
  return count_narrow_faces(surface, panels, sliver_mm) - count_narrow_faces(surface, panels, narrow_mm);
}

std::size_t count_narrow_faces(const mesh::Surface& surface, const Panels& panels, double width) {
  std::size_t narrow = 0;
  for (const PanelId p : ids<PanelId>(panels.count())) {
    narrow += is_narrow(surface, panels, p, width) ? panels.faces[p].size() : 0;
  }
  return narrow;
}

}  // namespace ridgecraft::prepare
