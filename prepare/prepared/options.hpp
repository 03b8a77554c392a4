// SPDX-License-Identifier: GPL-3.0-or-later
// How a model is made ready for paper: values that users choose.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "base/geometry.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/rolls.hpp"

namespace ridgecraft::prepare {

/// Smaller folds get no line, so nobody has to fold them, radians (3 degrees): what a user may change by one
/// option for the drawing, for simplification and for warnings alike.
inline constexpr double hidden_fold_angle = 3.0 * 3.14159265358979323846 / 180.0;

/// So many loose bodies can be kept apart on a table.
inline constexpr std::size_t most_loose_bodies = 10;

/// How large the model becomes.
struct SizeOptions {
  /// Largest extent in mm. Used when neither scale nor an axis is given.
  double largest_extent_mm = 150.0;
  /// Where the model can't be folded at that size, its tabs and numbers have too little room there, it takes
  /// more than most_pages, or simplification would be seen, another one is looked for.
  bool adapts = false;
  double smallest_mm = 100.0;  ///< that is looked for
  double largest_mm = 400.0;
  double most_pages = 8.0;
  /// Millimetres for one unit of the file; wins over largest_extent_mm.
  std::optional<double> mm_per_unit;
  /// Largest extent in mm at which it was judged which bodies are too small, where the size is another one
  /// now.
  std::optional<double> judged_at_mm;
};

/// How many faces it keeps.
enum class Simplification { automatic, keep, count };

/// What becomes of thin walls with a skin on either side: one of the skins, a sheet between them, or both
/// stay.
enum class Skins { outer, middle, both };

/// When a model has too many faces to be folded, and what becomes of it then.
struct SimplifyOptions {
  Simplification mode = Simplification::automatic;
  std::size_t faces = 0;  ///< for Simplification::count
  /// automatic: what is smaller is a detail, ...
  double short_edge_mm = 6.0;
  /// ... and what is lower than this can't be folded.
  double tiny_edge_mm = 3.0;
  /// automatic: the model is simplified until it keeps this.
  Budget budget;
  /// automatic: a model that is no more work than this, and whose edges keep the budget, stays as it is.
  double most_own_hours = 10.0;
  /// automatic: nobody builds a model of more triangles, however flat its folds are.
  std::size_t most_faces = 1000;
  /// automatic: the surface may move by this share of the model's largest extent.
  double largest_deviation = 0.02;
  /// Walls are thin below tiny_edge_mm: their rims are lower than can be folded.
  Skins skins = Skins::outer;
  /// What rises from a flat face becomes a component of its own, to be glued onto it, however many faces the
  /// model keeps.
  bool part_attached = false;
  /// Folds of less are drawn as no line, so they don't count; radians.
  double hidden_fold_angle = prepare::hidden_fold_angle;
  RollRules rolls;
};

/// As expected_work() says, where the panels are still to be found. What can be rolled counts as if it was
/// folded: rolling saves work, which isn't spent on more detail. O(n log n).
[[nodiscard]] inline Work expected_work(const mesh::Surface& surface, const SimplifyOptions& simplify,
                                        double mm = 1.0) {
  return expected_work(surface, find_panels(surface), {}, simplify.hidden_fold_angle, mm);
}

/// What a model keeps that stays as it is: who asks for less than an evening gets it.
[[nodiscard]] inline Budget own_budget(const SimplifyOptions& simplify) {
  Budget budget = simplify.budget;
  if (budget.hours >= Budget{}.hours) {
    budget.hours = std::max(budget.hours, simplify.most_own_hours);
  }
  return budget;
}

/// What a flat region should fit, mm.
struct PanelRoom {
  Rectangle sheet;      ///< the printable area
  double tab_mm = 0.0;  ///< height of tabs on either side of the region
};

}  // namespace ridgecraft::prepare
