// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/forest.hpp"

#include "base/error.hpp"

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

}  // namespace ridgecraft::unfold
