// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/panel_regions.hpp"

#include "base/disjoint_sets.hpp"

namespace ridgecraft::prepare {

PanelRegions::PanelRegions(const mesh::Surface& surface, const Panels& panels, const mesh::LooseFaces& loose)
    : surface_(surface) {
  find_regions(panels, loose);
  find_borders();
}

void PanelRegions::find_regions(const Panels& panels, const mesh::LooseFaces& loose) {
  DisjointSets sets(surface_.face_count());
  for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
    const auto [c, d] = surface_.sides(e);
    if (d.valid()) {
      const FaceId f = mesh::face_of(c);
      const FaceId g = mesh::face_of(d);
      const bool one_material =
          loose.material.empty() || loose.material[f.value()] == loose.material[g.value()];
      if (panels.panel[f] == panels.panel[g] && one_material) {
        sets.join(f.value(), g.value());
      }
    }
  }
  region_.resize(surface_.face_count());
  for (std::uint32_t f = 0; f < region_.size(); ++f) {
    const std::uint32_t root = sets.find(f);
    if (root == f) {
      region_[f] = static_cast<std::uint32_t>(faces_.size());
      faces_.emplace_back();
    } else {
      region_[f] = region_[root];
    }
    faces_[region_[f]].push_back(f);
  }
}

bool PanelRegions::on_border(EdgeId edge) const {
  const auto [c, d] = surface_.sides(edge);
  return !d.valid() || region_[mesh::face_of(c).value()] != region_[mesh::face_of(d).value()];
}

void PanelRegions::find_borders() {
  border_edges_.assign(surface_.vertex_count(), {});
  for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
    if (on_border(e)) {
      const CornerId c = surface_.sides(e)[0];
      border_edges_[surface_.vertex(c).value()].push_back(e.value());
      border_edges_[surface_.vertex(mesh::next(c)).value()].push_back(e.value());
    }
  }
}

}  // namespace ridgecraft::prepare
