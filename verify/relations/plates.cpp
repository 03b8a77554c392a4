// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/relations/plates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ridgecraft::verify {
namespace {

/// Whether each crease moves one further plate, and none that is nearer to the middle than one before.
bool grows_from(Index middle, std::span<const Crease* const> order) {
  std::map<Index, Index> depth{{middle, 0}};
  Index deepest = 0;
  for (const Crease* crease : order) {
    const auto first = depth.find(crease->first);
    const auto second = depth.find(crease->second);
    if ((first == depth.end()) == (second == depth.end())) {
      return false;
    }
    const Index now = (first != depth.end() ? first : second)->second + 1;
    if (now < deepest) {
      return false;
    }
    deepest = now;
    depth[first != depth.end() ? crease->second : crease->first] = now;
  }
  return true;
}

}  // namespace

Plates find_plates(const File& file, const Relations& relations, double flat_deg) {
  DisjointSets sets(file.faces.faces());
  for (Index side = 0; side < file.faces.sides(); ++side) {
    const Index twin = relations.fold_twin[side];
    if (twin != none && std::abs(file.edges[file.side_edge[side]].angle_deg) < flat_deg) {
      sets.join(file.faces.face(side), file.faces.face(twin));
    }
  }
  Plates plates;
  std::vector<Index> number(file.faces.faces(), none);
  for (Index face = 0; face < file.faces.faces(); ++face) {
    Index& of_set = number[sets.find(face)];
    of_set = of_set == none ? plates.count++ : of_set;
    plates.plate.push_back(of_set);
  }
  return plates;
}

std::vector<std::vector<Crease>> find_creases(const File& file, const Relations& relations,
                                              const Plates& plates) {
  std::map<std::pair<Index, Index>, Crease> by_plates;
  for (Index side = 0; side < file.faces.sides(); ++side) {
    const Index twin = relations.fold_twin[side];
    if (twin == none || twin < side) {
      continue;
    }
    const auto [low, high] =
        std::minmax(plates.plate[file.faces.face(side)], plates.plate[file.faces.face(twin)]);
    if (low != high) {
      Crease& crease = by_plates[{low, high}];
      crease.first = low;
      crease.second = high;
      crease.edges.push_back(file.side_edge[side]);
    }
  }
  std::vector<std::vector<Crease>> creases(file.pieces.size());
  for (auto& [pair, crease] : by_plates) {
    const Index side = relations.sides_of(crease.edges.front()).front();
    creases[file.face_piece[file.faces.face(side)]].push_back(std::move(crease));
  }
  return creases;
}

bool goes_inwards(std::span<const Crease* const> order) {
  const std::vector<const Crease*> outwards(order.rbegin(), order.rend());
  return grows_from(outwards.front()->first, outwards) || grows_from(outwards.front()->second, outwards);
}

}  // namespace ridgecraft::verify
