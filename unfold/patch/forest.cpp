// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/forest.hpp"

namespace ridgecraft::unfold {

RootedTree rooted_tree(const Patch& patch, const Folds& folds, std::uint32_t root,
                       std::vector<std::uint32_t>& place) {
  RootedTree tree;
  tree.order.push_back(root);
  tree.up.push_back(nothing);
  tree.parent.push_back(nothing);
  place[root] = 0;
  for (std::uint32_t i = 0; i < tree.order.size(); ++i) {
    const std::uint32_t f = tree.order[i];
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (folds[side] == 0 || side == tree.up[i]) {
        continue;
      }
      const std::uint32_t twin = patch.twin[side];
      place[twin / 3] = static_cast<std::uint32_t>(tree.order.size());
      tree.order.push_back(twin / 3);
      tree.up.push_back(twin);
      tree.parent.push_back(i);
    }
  }
  return tree;
}

}  // namespace ridgecraft::unfold
