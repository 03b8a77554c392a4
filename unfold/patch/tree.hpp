// SPDX-License-Identifier: GPL-3.0-or-later
// Spanning trees of a patch: their roots, branches, and where a search begins.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

// A piece of a forest of folds as a rooted tree.

struct RootedTree {
  std::vector<std::uint32_t> order;  ///< faces, parents before children
  std::vector<std::uint32_t> up;  ///< per place in order: the face's side to its parent; nothing at the root
  std::vector<std::uint32_t> parent;  ///< per place in order: the parent's place; nothing at the root
};

/// The tree of folds that holds `root`. O(its size). `place` must have a slot for each face of the patch;
/// afterwards it has the place in order of each face of the tree, other slots are left alone. Throws
/// Error(internal) where the folds close a circle, which no tree does.
[[nodiscard]] RootedTree rooted_tree(const Patch& patch, const Folds& folds, std::uint32_t root,
                                     std::vector<std::uint32_t>& place);

/// Sets or clears the fold on both sides of an edge.
inline void set_fold(const Patch& patch, Folds& folds, std::uint32_t side, bool folded) {
  folds[side] = folds[patch.twin[side]] = folded ? 1 : 0;
}

// Spanning trees to begin with.

/// As many frozen sides as trees can hold.
[[nodiscard]] Folds frozen_folds(const Patch& patch);

/// One side of each edge that isn't frozen, the longest first, those of one length in random order.
[[nodiscard]] std::vector<std::uint32_t> longest_first(const Patch& patch, Random& random);

/// The spanning tree of a connected patch with the longest folds, so the shortest cuts, that holds as many
/// frozen sides as a tree can (J. Kruskal 1956). O(n log n).
[[nodiscard]] Folds start_tree(const Patch& patch, Random& random);

/// Fisher and Yates; std::shuffle differs between libraries.
template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
  }
}

// What it costs that much paper hangs on little: on a short fold, or on a face that is narrow between two
// folds.

/// A neck is thin when the branch behind it is this many times wider than it.
inline constexpr double thin_ratio = 3.0;
/// Narrower ones tear, mm, where more paper than this hangs on either side, mm2; what such a one counts more,
/// mm: to hang the branch elsewhere, or to cut it off, is worth that, whatever a piece costs.
inline constexpr double thread_mm = 1.0;
inline constexpr double held_by_thread_mm2 = 25.0;
inline constexpr double thread_cost = 25'000.0;

/// By how much the smaller side of a fold (the root of its area, mm2) is wider than is harmless, mm; more
/// where the fold is but a thread.
[[nodiscard]] inline double neck_cost(double fold_mm, double held_mm2) {
  const double harmless = thin_ratio * fold_mm;
  if (held_mm2 <= harmless * harmless) {
    return 0.0;
  }
  const bool tears = fold_mm < thread_mm && held_mm2 > held_by_thread_mm2;
  return std::sqrt(held_mm2) - harmless + (tears ? thread_cost : 0.0);
}

/// The same for a face between two folds whose third side, an outline, comes near the corner where they meet:
/// what hangs on either of the two, mm2.
[[nodiscard]] inline double thread_cost_between(double one_mm2, double other_mm2) {
  return std::min(one_mm2, other_mm2) > held_by_thread_mm2 ? thread_cost : 0.0;
}

/// Per side: 1 where the corner across comes that near. Empty where there is none.
[[nodiscard]] inline std::vector<std::uint8_t> narrow_sides(const Patch& patch) {
  std::vector<std::uint8_t> narrow(patch.twin.size(), 0);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const Triangle& t = patch.shape[side / 3];
    const std::uint32_t k = side % 3;
    narrow[side] = distance_to_segment(t[(k + 2) % 3], t[k], t[(k + 1) % 3]) < thread_mm ? 1 : 0;
  }
  if (std::none_of(narrow.begin(), narrow.end(), [](std::uint8_t n) { return n != 0; })) {
    narrow.clear();
  }
  return narrow;
}

/// The only side of a face that is no fold, or nothing.
[[nodiscard]] inline std::uint32_t only_cut(const Folds& folds, std::uint32_t face) {
  std::uint32_t cut = no_index;
  for (std::uint32_t side = 3 * face; side < 3 * face + 3; ++side) {
    if (folds[side] == 0) {
      if (cut != no_index) {
        return no_index;
      }
      cut = side;
    }
  }
  return cut;
}

}  // namespace ridgecraft::unfold
