// SPDX-License-Identifier: GPL-3.0-or-later
// What bench_tabs counts on a net with its tabs, and over many nets.
#pragma once

#include <span>
#include <vector>

#include "bench/tab_bound.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::bench {

/// What the weak rule allows tabs to overlap, mm.
inline constexpr double weak_overlap_mm = 0.01;

/// The nets of one model, or the mean of many; all shares are of cut edges.
struct TabFigures {
  double models = 0.0;
  double pieces = 0.0;         ///< of a model
  double pieces_in_all = 0.0;  ///< sum over the models
  double most_more = 0.0;      ///< pieces beyond the first, of the model that has most
  double cuts = 0.0;
  double usable = 0.0;
  double any = 0.0;
  double of_wide = 0.0;        ///< of those that are long and wide enough for a usable tab (Join::too_narrow)
  double of_able = 0.0;        ///< of those that geometry allows one (TabBound::able)
  double usable_long = 0.0;    ///< of those longer than long_edge_mm
  double of_bound = 0.0;       ///< share of what geometry allows one net
  double of_long_bound = 0.0;  ///< the same of the long ones
  double left = 0.0;           ///< cuts that are wide enough and have none, sum over the models
  double collisions = 0.0;     ///< sum over the models
};

/// Every member with its name in the JSON, so that sums, medians and output need be written once.
struct TabFigure {
  const char* name;
  double TabFigures::*value;
};
[[nodiscard]] std::span<const TabFigure> tab_figures();

/// Collisions are counted by brute force: each tab against all faces and tabs of its piece.
[[nodiscard]] TabFigures figures_of(const mesh::Surface& surface, const TabBound& bound,
                                    const unfold::Nets& nets, const unfold::TabOptions& options);

[[nodiscard]] TabFigures mean_of_models(const std::vector<TabFigures>& all);

/// The median of each figure; of what must not happen the worst.
[[nodiscard]] TabFigures median_of_seeds(const std::vector<TabFigures>& all);

/// The value below which this share of the values lies; 0 when there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace ridgecraft::bench
