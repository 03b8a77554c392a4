// SPDX-License-Identifier: GPL-3.0-or-later
// A piece of a forest of folds as a rooted tree.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

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

}  // namespace ridgecraft::unfold
