// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/tree.hpp"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/random.hpp"

namespace ridgecraft::unfold {

RootedTree rooted_tree(const Patch& patch, const Folds& folds, std::uint32_t root,
                       std::vector<std::uint32_t>& place) {
  RootedTree tree;
  tree.order.push_back(root);
  tree.up.push_back(no_index);
  tree.parent.push_back(no_index);
  place[root] = 0;
  for (std::uint32_t i = 0; i < tree.order.size(); ++i) {
    const std::uint32_t f = tree.order[i];
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (folds[side] == 0 || side == tree.up[i]) {
        continue;
      }
      const std::uint32_t twin = patch.twin[side];
      if (const std::uint32_t at = place[twin / 3]; at < tree.order.size() && tree.order[at] == twin / 3) {
        throw Error(ErrorKind::internal, "the folds of a piece close a circle");
      }
      place[twin / 3] = static_cast<std::uint32_t>(tree.order.size());
      tree.order.push_back(twin / 3);
      tree.up.push_back(twin);
      tree.parent.push_back(i);
    }
  }
  return tree;
}

Folds frozen_folds(const Patch& patch) {
  Folds folds(patch.twin.size(), 0);
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && patch.frozen[side] != 0 &&
        sets.join(side / 3, patch.twin[side] / 3)) {
      set_fold(patch, folds, side, true);
    }
  }
  return folds;
}

std::vector<std::uint32_t> longest_first(const Patch& patch, Random& random) {
  std::vector<std::uint32_t> sides;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && side < patch.twin[side] && patch.frozen[side] == 0) {
      sides.push_back(side);
    }
  }
  shuffle(sides, random);
  std::stable_sort(sides.begin(), sides.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return patch.length[a] > patch.length[b]; });
  return sides;
}

Folds start_tree(const Patch& patch, Random& random) {
  Folds folds = frozen_folds(patch);
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (folds[side] != 0) {
      static_cast<void>(sets.join(side / 3, patch.twin[side] / 3));
    }
  }
  for (const std::uint32_t side : longest_first(patch, random)) {
    if (sets.join(side / 3, patch.twin[side] / 3)) {
      set_fold(patch, folds, side, true);
    }
  }
  return folds;
}

}  // namespace ridgecraft::unfold
