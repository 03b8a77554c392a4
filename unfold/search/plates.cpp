// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/plates.hpp"

#include "base/disjoint_sets.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// The panel of one of its faces; `taken` has a flag for each face.
Plate plate_at(const Patch& patch, std::uint32_t first, std::vector<std::uint8_t>& taken) {
  Plate plate;
  plate.faces.push_back(first);
  plate.place.emplace_back();
  taken[first] = 1;
  for (std::size_t i = 0; i < plate.faces.size(); ++i) {
    const std::uint32_t f = plate.faces[i];
    const Rigid at = plate.place[i];
    const Triangle& shape = patch.shape[f];
    const Triangle laid{at(shape[0]), at(shape[1]), at(shape[2])};
    plate.flat.push_back(edged(laid));
    plate.circle.push_back(smallest_circle(laid[0], laid[1], laid[2]));
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (patch.frozen[side] != 0 && taken[patch.twin[side] / 3] == 0) {
        taken[patch.twin[side] / 3] = 1;
        plate.faces.push_back(patch.twin[side] / 3);
        plate.place.push_back(at * patch.across[side]);
      }
    }
  }
  return plate;
}

}  // namespace

std::vector<Plate> plates_of(const Patch& patch) {
  std::vector<Plate> plates;
  std::vector<std::uint8_t> taken(patch.size(), 0);
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    if (taken[f] == 0) {
      plates.push_back(plate_at(patch, f, taken));
    }
  }
  return plates;
}

std::vector<Arc> arcs_between(const Patch& patch, const std::vector<Plate>& plates) {
  std::vector<std::uint32_t> plate_of(patch.size(), 0);
  std::vector<Rigid> place(patch.size());
  for (std::uint32_t p = 0; p < plates.size(); ++p) {
    for (std::size_t i = 0; i < plates[p].faces.size(); ++i) {
      plate_of[plates[p].faces[i]] = p;
      place[plates[p].faces[i]] = plates[p].place[i];
    }
  }
  std::vector<Arc> arcs;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != no_index && side < twin && plate_of[side / 3] != plate_of[twin / 3]) {
      arcs.push_back({side, plate_of[side / 3], plate_of[twin / 3],
                      place[side / 3] * patch.across[side] * place[twin / 3].inverse()});
    }
  }
  return arcs;
}

Folds folds_of_plates(const Patch& patch, const std::vector<Plate>& plates) {
  Folds folds(patch.twin.size(), 0);
  DisjointSets sets(patch.size());
  for (const Plate& plate : plates) {
    for (const std::uint32_t f : plate.faces) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (patch.frozen[side] != 0 && sets.join(f, patch.twin[side] / 3)) {
          set_fold(patch, folds, side, true);
        }
      }
    }
  }
  return folds;
}

}  // namespace ridgecraft::unfold
