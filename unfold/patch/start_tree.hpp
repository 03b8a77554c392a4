// SPDX-License-Identifier: GPL-3.0-or-later
// Spanning trees to begin with.
#pragma once

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

enum class StartTree {
  depth_first,    ///< long strips: cheapest to free of overlaps, worst on pages
  breadth_first,  ///< round about a random root
  short_cuts,     ///< the folds are as long as possible altogether, so the cuts are short
  flat_folds,     ///< flattest folds first: cuts lie on sharp edges
};

/// A spanning tree of a connected patch that holds as many frozen sides as a tree can. O(n log n).
[[nodiscard]] Folds start_tree(const Patch& patch, StartTree kind, Random& random);

/// Fisher and Yates; std::shuffle differs between libraries.
template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
  }
}

}  // namespace ridgecraft::unfold
