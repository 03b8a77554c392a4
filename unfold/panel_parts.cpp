// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/panel_parts.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace ridgecraft::unfold {

IdVector<FaceId, PartId> parts_of_whole_panels(const mesh::Surface& surface, const mesh::Panels& panels,
                                               const IdVector<FaceId, PartId>& part) {
  IdVector<FaceId, PartId> chosen = part;
  for (const std::vector<FaceId>& faces : panels.faces) {
    std::map<PartId, double> area;
    for (const FaceId f : faces) {
      area[part[f]] += surface.area(f);
    }
    const auto most = std::max_element(area.begin(), area.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const FaceId f : faces) {
      chosen[f] = most->first;
    }
  }
  std::map<PartId, PartId> number;
  for (PartId& p : chosen) {
    p = number.try_emplace(p, PartId(number.size())).first->second;
  }
  return chosen;
}

}  // namespace ridgecraft::unfold
