// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the forest that costs least: simulated annealing over single moves, with prices that rise.
//
// Source: S. Kirkpatrick, C. Gelatt, M. Vecchi, Optimization by simulated annealing, Science 220, 1983.
// Overlaps are allowed at a price that rises until none pays (exact penalties), so that two pieces may be
// joined first and their net repaired afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/context.hpp"
#include "base/elementary.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// A patch whose faces are to lie in trees. It refers to what it was made of, which must outlive it.
struct ForestProblem {
  const mesh::Surface& surface;
  const prepare::Panels& panels;
  const Patch& patch;
  std::span<const std::uint32_t> part;  ///< per face of the patch; empty: all of one
  const TabOptions& tabs;
  const Room& room;
  const Weights& weights;
  /// As in CutFacts; empty without symmetry.
  std::span<const SideImages> images = {};
};

struct SearchRules {
  /// Moves that are tried with the space for tabs estimated by angles, overlaps allowed on the way.
  std::uint64_t quick_trials = 0;
  /// Moves that are looked at afterwards with the tabs as they are, none with a new overlap.
  std::uint64_t exact_trials = 0;
  /// A move that costs d, mm, is made with probability exp(-d / heat): heat at the beginning.
  double first_heat = 20.0;
  /// Price of an overlap at the beginning, mm: how freely pieces are joined whose net is repaired later.
  double first_overlap_price = 20.0;
  /// Whether each tree must fold up with all creases together; the forest is one tree at first. Moves are
  /// made without their images: looking at how all of these fold takes eight times as long for nothing.
  bool folds_together = false;
};

/// The trials for so many faces of which each is worth `trials_per_face`: fewer for each where there are
/// many.
[[nodiscard]] SearchRules rules_for(double trials_per_face, std::uint32_t faces);

/// The best forest without overlap that fits the room which the search comes to from `start`; `start` itself
/// where it comes to none, or to none that costs less. A move is made together with its images. Deterministic
/// for one seed except for the deadline. Throws Error(interrupted).
[[nodiscard]] Folds search_forest(const ForestProblem& problem, const Folds& start, const SearchRules& rules,
                                  std::uint64_t seed, const Context& context);

/// What a forest costs with its tabs as they are, mm; nothing where it doesn't fit the room. O(n log n).
[[nodiscard]] std::optional<double> exact_cost(const ForestProblem& problem, const Folds& folds);

/// A value between two, in equal ratios for equal steps of `share` from 0 to 1.
[[nodiscard]] inline double between(double first, double last, double share) {
  return first * elementary::pow(last / first, share);
}

}  // namespace ridgecraft::unfold
