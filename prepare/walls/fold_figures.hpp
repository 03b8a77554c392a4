// SPDX-License-Identifier: GPL-3.0-or-later
// How many folds of a surface are too short, as far as anything could be done about them. Private to
// prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// Folds that are drawn: edges between panels, folded by hidden_fold_angle or more.
struct FoldFigures {
  std::size_t folds = 0;
  /// Shorter than short_edge_mm, though the walls at their ends would let them be longer: where these have no
  /// point in common near the edge, no simplification that keeps walls makes it longer.
  std::size_t brief = 0;
  /// Shorter than tiny_edge_mm; across a plate, from one wall to a parallel one, shorter than half of that:
  /// the fold along the plate is long.
  std::size_t tiny = 0;

  /// Edges between panels, drawn or not, and those of them between which numbers and tabs have little room.
  std::size_t edges = 0;
  std::size_t close = 0;
  /// Lengths of these edges, mm, and of those of them that are shorter than short_edge_mm.
  double length = 0.0;
  double cramped = 0.0;

  /// Whether most edges are too close for a model of many faces.
  [[nodiscard]] bool crowded() const { return 2 * close > edges; }
  /// Shares of the folds; 0 where there are none.
  [[nodiscard]] double brief_share() const { return share(brief); }
  [[nodiscard]] double tiny_share() const { return share(tiny); }
  [[nodiscard]] double cramped_share() const { return length > 0.0 ? cramped / length : 0.0; }

 private:
  [[nodiscard]] double share(std::size_t count) const {
    return folds == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(folds);
  }
};

/// Panels must have been remeshed: then a straight fold between two of them is one
/// edge. O(n).
[[nodiscard]] FoldFigures fold_figures(const mesh::Surface& surface, const SimplifyOptions& options);
/// The same where panels and walls (without slats) are known.
[[nodiscard]] FoldFigures fold_figures(const mesh::Surface& surface, const Panels& panels, const Walls& walls,
                                       const SimplifyOptions& options);

/// Of each component: whether it can't be folded as it is, or has more faces than anybody builds. Panels must
/// have been remeshed. O(n).
[[nodiscard]] std::vector<bool> too_fine_components(const mesh::Surface& surface,
                                                    const SimplifyOptions& options);

}  // namespace ridgecraft::prepare
