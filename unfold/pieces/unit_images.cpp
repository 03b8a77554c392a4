// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/unit_images.hpp"

#include <map>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::unfold {
namespace {

/// A unit is the image of another when so much of its outline is: its neighbours share an edge only.
constexpr double share_of_outline = 0.9;

}  // namespace

std::vector<std::uint32_t> units_of(const Patch& patch) {
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.frozen[side] != 0) {
      static_cast<void>(sets.join(side / 3, patch.twin[side] / 3));
    }
  }
  std::vector<std::uint32_t> unit(patch.size());
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    unit[f] = sets.find(f);
  }
  return unit;
}

std::vector<std::uint32_t> unit_images(const mesh::Surface& surface, const Patch& patch,
                                       std::span<const std::uint32_t> unit,
                                       const IdVector<EdgeId, EdgeId>& images) {
  // Of each unit: how much of its outline, and how much of that is the image of an edge of which unit.
  std::vector<double> outline(patch.size(), 0.0);
  std::vector<std::map<std::uint32_t, double>> votes(patch.size());
  IdVector<EdgeId, std::vector<std::uint32_t>> units_at(surface.edge_count());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.frozen[side] == 0) {
      units_at[surface.edge(mesh::corner(patch.face[side / 3], side % 3))].push_back(unit[side / 3]);
    }
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    for (const std::uint32_t u : units_at[e]) {
      outline[u] += surface.length(e);
      if (images[e].valid()) {
        for (const std::uint32_t v : units_at[images[e]]) {
          votes[u][v] += surface.length(e);
        }
      }
    }
  }
  std::vector<std::uint32_t> best(patch.size(), nothing);
  for (std::uint32_t u = 0; u < patch.size(); ++u) {
    for (const auto& [v, length] : votes[u]) {
      if (length >= share_of_outline * outline[u]) {
        best[u] = v;
      }
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
