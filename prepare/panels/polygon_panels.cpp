// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/polygon_panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "mesh/model/soup.hpp"

namespace ridgecraft::prepare {
namespace {

/// What bends more was hardly meant to be one face.
constexpr double nearly_flat = 20.0 * std::numbers::pi / 180.0;

}  // namespace

Panels find_polygon_panels(const mesh::Model& model) {
  const mesh::Surface& surface = model.surface;
  Panels panels = find_panels(surface);
  bool any = false;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (!d.valid()) {
      continue;
    }
    const FaceId f = mesh::face_of(c);
    const FaceId g = mesh::face_of(d);
    const PanelId p = panels.panel[f];
    const PanelId q = panels.panel[g];
    const bool alone = p != q && panels.faces[p].size() == 1 && panels.faces[q].size() == 1;
    if (alone && model.polygon[f] != mesh::Soup::none && model.polygon[f] == model.polygon[g] &&
        std::abs(surface.fold_angle(e)) < nearly_flat) {
      panels.panel[g] = p;
      panels.faces[p] = {std::min(f, g), std::max(f, g)};
      panels.faces[q].clear();
      any = true;
    }
  }
  if (!any) {
    return panels;
  }
  // Without the empty ones.
  IdVector<PanelId, std::vector<FaceId>> faces;
  for (std::vector<FaceId>& of_panel : panels.faces) {
    if (!of_panel.empty()) {
      for (const FaceId f : of_panel) {
        panels.panel[f] = PanelId(static_cast<std::uint32_t>(faces.size()));
      }
      faces.push_back(std::move(of_panel));
    }
  }
  panels.faces = std::move(faces);
  return panels;
}

}  // namespace ridgecraft::prepare
