// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/annealing.hpp"

#include <algorithm>

#include "base/elementary.hpp"

namespace ridgecraft::unfold {
namespace {

/// Nets of so many faces get all trials for each; those of more get as many in all as this power of their
/// number: each trial takes longer there, too.
constexpr double ordinary_faces = 250.0;
constexpr double growth = 0.4;
/// Trials of the quick half for each one of the exact half.
constexpr double quick_for_exact = 80.0;

}  // namespace

Annealing annealing_for(double trials_per_face, std::uint32_t faces) {
  const double more = std::max(1.0, static_cast<double>(faces) / ordinary_faces);
  const double trials = trials_per_face * static_cast<double>(faces) * elementary::pow(more, growth - 1.0);
  return {static_cast<std::uint64_t>(trials), static_cast<std::uint64_t>(trials / quick_for_exact)};
}

}  // namespace ridgecraft::unfold
