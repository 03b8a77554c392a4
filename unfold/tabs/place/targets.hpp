// SPDX-License-Identifier: GPL-3.0-or-later
// What the faces behind which tabs are glued allow, whatever the net: known before any search.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// Per side of a patch, for a tab that grows from it.
struct TabTargets {
  std::vector<std::vector<Obstacle>>
      outline;                       ///< of the panel it is glued behind, near the edge; frame of tab shapes
  std::vector<ConvexShape> largest;  ///< usable and inside that panel or, where it is too narrow, across
                                     ///< slight folds; empty if there is none
  /// Folds (one side of each) behind which `largest` lies beside that panel: it needs them to be folds. None
  /// where the panel alone is wide enough.
  std::vector<std::vector<std::uint32_t>> across;
  /// 1 where the edge leads out of the patch and this side is the one that should give the tab: the smaller
  /// panel, unless only the other one has a target large enough.
  std::vector<std::uint8_t> seam;
};

/// Panels are taken as whole. Sides inside a panel and at borders of the surface have no target. O(n), but
/// for panels of very many sides.
[[nodiscard]] TabTargets find_tab_targets(const mesh::Surface& surface, const prepare::Panels& panels,
                                          const Patch& patch, const TabOptions& options);

}  // namespace ridgecraft::unfold
