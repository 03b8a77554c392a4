// SPDX-License-Identifier: GPL-3.0-or-later
// How long and how hot the search for a net of less energy is.
#pragma once

#include <cstdint>

#include "base/elementary.hpp"

namespace ridgecraft::unfold {

struct Annealing {
  /// Swaps that are tried with tabs told by angles, overlaps allowed on the way.
  std::uint64_t quick_trials = 0;
  /// Swaps that are looked at afterwards with the tabs as they are, none with a new overlap.
  std::uint64_t exact_trials = 0;
  /// A swap that costs d, mm, is taken with probability exp(-d / heat): heat at the beginning.
  double first_heat = 20.0;
  /// The quick half ends with the first clean net that fits the room and costs less than the one given.
  bool until_it_fits = false;
};

/// The trials for a net of so many faces of which each is worth `trials_per_face` (Options): fewer for each
/// where there are many.
[[nodiscard]] Annealing annealing_for(double trials_per_face, std::uint32_t faces);

/// A value between two, in equal ratios for equal steps of `share` from 0 to 1.
[[nodiscard]] inline double between(double first, double last, double share) {
  return first * elementary::pow(last / first, share);
}

}  // namespace ridgecraft::unfold
