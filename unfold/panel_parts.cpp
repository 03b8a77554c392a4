// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/panel_parts.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {
namespace {

/// What lies apart from the rest of its part: everything but each part's largest component, smallest first.
std::vector<std::vector<FaceId>> crumbs(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part) {
  std::map<PartId, std::vector<FaceId>> faces;
  for (const FaceId f : ids<FaceId>(part.size())) {
    faces[part[f]].push_back(f);
  }
  std::vector<std::vector<FaceId>> found;
  for (const auto& [p, all] : faces) {
    std::vector<std::vector<FaceId>> components = connected(surface, all);
    const auto largest = std::max_element(
        components.begin(), components.end(),
        [&](const auto& a, const auto& b) { return area_of(surface, a) < area_of(surface, b); });
    components.erase(largest);
    std::move(components.begin(), components.end(), std::back_inserter(found));
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return area_of(surface, a) < area_of(surface, b); });
  return found;
}

/// Gives the crumb to the part with which it has the longest border; false where it has none with any.
bool give_away(const mesh::Surface& surface, const std::vector<FaceId>& crumb,
               IdVector<FaceId, PartId>& part) {
  const PartId own = part[crumb.front()];
  std::map<PartId, double> border;
  for (const FaceId f : crumb) {
    for (unsigned k = 0; k < 3; ++k) {
      const FaceId g = surface.neighbor(mesh::corner(f, k));
      if (g.valid() && part[g] != own) {
        border[part[g]] += surface.length(surface.edge(mesh::corner(f, k)));
      }
    }
  }
  if (border.empty()) {
    return false;
  }
  const auto longest = std::max_element(border.begin(), border.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const FaceId f : crumb) {
    part[f] = longest->first;
  }
  return true;
}

}  // namespace

IdVector<FaceId, PartId> parts_of_whole_panels(const mesh::Surface& surface, const prepare::Panels& panels,
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
  for (bool again = true; again;) {
    again = false;
    for (const std::vector<FaceId>& crumb : crumbs(surface, chosen)) {
      // One at a time: what it joins may hold other crumbs together.
      if (give_away(surface, crumb, chosen)) {
        again = true;
        break;
      }
    }
  }
  std::map<PartId, PartId> number;
  for (PartId& p : chosen) {
    p = number.try_emplace(p, PartId(number.size())).first->second;
  }
  return chosen;
}

}  // namespace ridgecraft::unfold
