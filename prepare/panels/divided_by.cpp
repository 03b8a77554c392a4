// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/divided_by.hpp"

#include <map>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::prepare {

Panels divided_by(const Panels& panels, const mesh::Surface& surface,
                  const IdVector<FaceId, std::uint32_t>& label) {
  DisjointSets sets(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (unsigned k = 0; k < 3; ++k) {
      const FaceId g = surface.neighbor(mesh::corner(f, k));
      if (g.valid() && panels.panel[g] == panels.panel[f] && label[g] == label[f]) {
        sets.join(f.value(), g.value());
      }
    }
  }
  Panels result;
  result.panel = IdVector<FaceId, PanelId>(surface.face_count());
  std::map<std::uint32_t, PanelId> number;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [at, fresh] = number.try_emplace(sets.find(f.value()));
    if (fresh) {
      at->second = result.faces.push_back({});
    }
    result.panel[f] = at->second;
    result.faces[at->second].push_back(f);
  }
  return result;
}

}  // namespace ridgecraft::prepare
