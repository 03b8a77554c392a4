// SPDX-License-Identifier: GPL-3.0-or-later
// A net that is larger than the sheet becomes as few pieces as possible.
#pragma once

#include <cstddef>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"

namespace ridgecraft::unfold {

/// What a forest costs: compared from the first figure to the last.
struct SplitCost {
  std::size_t pieces = 0;
  std::size_t cut_panels = 0;  ///< cuts inside panels
  double cut_mm = 0.0;

  friend bool operator<(const SplitCost& a, const SplitCost& b) {
    if (a.pieces != b.pieces) {
      return a.pieces < b.pieces;
    }
    if (a.cut_panels != b.cut_panels) {
      return a.cut_panels < b.cut_panels;
    }
    return a.cut_mm < b.cut_mm;
  }
};

/// The cost of a forest: its cuts between faces of the patch.
[[nodiscard]] SplitCost cost_of(const Patch& patch, const Folds& folds);

/// Removes folds until every piece fits. From several roots, each tree is cut from its leaves upwards only
/// where a branch no longer fits; the forest with the fewest pieces is kept. Panels stay whole. O(roots n h),
/// h the corners of the hulls.
[[nodiscard]] Folds split_to_fit(const Patch& patch, const Folds& folds, const Room& room, Random& random,
                                 const Context& context);

}  // namespace ridgecraft::unfold
