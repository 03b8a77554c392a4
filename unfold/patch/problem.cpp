// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/problem.hpp"

#include <algorithm>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {

bool Room::holds(std::span<const Vec2> hull, std::size_t panels) const {
  if (max_panels > 0 && panels > max_panels) {
    return false;
  }
  if (!sheet) {
    return true;
  }
  if (angle_to_fit(hull, {sheet->width - 2.0 * strip, sheet->height - 2.0 * strip})) {
    return true;
  }
  return panels == 1 && angle_to_fit(hull, *sheet).has_value();
}

std::size_t panel_count(const Patch& patch) {
  DisjointSets sets(patch.size());
  std::size_t panels = patch.size();
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.frozen[side] == frozen_in_panel && side < patch.twin[side] &&
        sets.join(side / 3, patch.twin[side] / 3)) {
      --panels;
    }
  }
  return panels;
}

std::size_t panels_of(const Patch& patch, const Folds& folds, const std::vector<std::uint32_t>& faces) {
  std::size_t panels = 1;
  for (const std::uint32_t f : faces) {
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      panels +=
          folds[side] != 0 && patch.frozen[side] != frozen_in_panel && side < patch.twin[side] ? 1U : 0U;
    }
  }
  return panels;
}

bool all_fit(const Patch& patch, const Folds& folds, const Room& room) {
  if (!room.sheet && room.max_panels == 0) {
    return true;
  }
  const Layout layout = lay_out(patch, folds);
  return std::all_of(layout.faces.begin(), layout.faces.end(), [&](const auto& faces) {
    return room.holds(hull_of(layout, faces), panels_of(patch, folds, faces));
  });
}

bool lies_as_one(const Patch& patch, std::size_t panels, const Room& room, double tolerance) {
  Random random(1);
  const Layout layout = lay_out(patch, start_tree(patch, random));
  return layout.faces.size() == 1 && room.holds(hull_of(layout, layout.faces.front()), panels) &&
         find_overlaps(layout, tolerance).empty();
}

}  // namespace ridgecraft::unfold
