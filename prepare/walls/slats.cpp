// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/walls/slats.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/panel_regions.hpp"
#include "prepare/panels/ruled_strips.hpp"

namespace ridgecraft::prepare {
namespace {

/// Slats are this share of a short edge wide at least.
constexpr double slat_width = 0.5;
constexpr double slat_edge = 75.0 * std::numbers::pi / 180.0;

}  // namespace

std::vector<bool> find_slats(const mesh::Surface& surface, const Panels& panels, double short_edge_mm) {
  std::vector<bool> slats(panels.count(), false);
  const PanelRegions regions(surface, panels, {});
  for (const RuledStrip& strip : ruled_strips(surface, regions, {})) {
    const auto at = [&](std::size_t line, std::size_t point) {
      const auto& points = strip.lines[line % strip.lines.size()].points;
      return surface.point(VertexId(points[point % points.size()]));
    };
    for (std::size_t i = 0; i < strip.regions.size(); ++i) {
      // Steps and grooves aren't bent, they have edges.
      if (std::min(strip.lines[i].fold, strip.lines[(i + 1) % strip.lines.size()].fold) >= slat_edge) {
        continue;
      }
      for (std::size_t t = 0; t < strip.regions[i].size(); ++t) {
        const double long_side =
            std::max(length(at(i, t + 1) - at(i, t)), length(at(i + 1, t + 1) - at(i + 1, t)));
        const double wide_side =
            std::max(length(at(i + 1, t) - at(i, t)), length(at(i + 1, t + 1) - at(i, t + 1)));
        const FaceId face(regions.faces(strip.regions[i][t]).front());
        if (long_side >= short_edge_mm && wide_side >= slat_width * short_edge_mm) {
          slats[panels.panel[face].value()] = true;
        }
      }
    }
  }
  return slats;
}

}  // namespace ridgecraft::prepare
