// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/needles.hpp"

#include <cstdint>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "prepare/prepared/narrow_faces.hpp"

namespace ridgecraft::unfold {
namespace {

/// So many flat regions are kept together at most: where all are narrow, nothing would be left to choose.
constexpr std::uint32_t most_together = 6;

}  // namespace

EdgeWishes with_needles_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                             const EdgeWishes& wishes) {
  EdgeWishes result = wishes;
  DisjointSets sets(panels.count());
  std::vector<std::uint32_t> together(panels.count(), 1);  // of each set, at its first
  for (const PanelId p : ids<PanelId>(panels.count())) {
    if (!prepare::is_narrow(surface, panels, p, needle_mm)) {
      continue;
    }
    EdgeId longest;
    std::uint32_t neighbour = 0;
    for (const FaceId f : panels.faces[p]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const EdgeId e = surface.edge(side);
        const FaceId beyond = surface.neighbor(side);
        const bool free =
            beyond.valid() && panels.panel[beyond] != p && (wishes.empty() || wishes[e] == EdgeWish::none);
        if (free && (!longest.valid() || surface.length(e) > surface.length(longest))) {
          longest = e;
          neighbour = panels.panel[beyond].value();
        }
      }
    }
    if (!longest.valid()) {
      continue;
    }
    const std::uint32_t both = together[sets.find(p.value())] + together[sets.find(neighbour)];
    if (both <= most_together && sets.join(p.value(), neighbour)) {
      together[sets.find(p.value())] = both;
      if (result.empty()) {
        result = EdgeWishes(surface.edge_count(), EdgeWish::none);
      }
      result[longest] = EdgeWish::needle;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
