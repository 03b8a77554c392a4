// SPDX-License-Identifier: GPL-3.0-or-later
// Single swaps of a tree: for searches that have overlap behind them.
#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {

const std::vector<std::uint32_t>& TreeSearch::removable_between(std::uint32_t f, std::uint32_t g) {
  find_path(f, g);
  removable_.clear();
  for (const Arc& arc : path_) {
    removable_.push_back(arc.below);
  }
  return removable_;
}

bool TreeSearch::swap_is_clean(std::uint32_t below, std::uint32_t side) {
  const std::uint32_t inner = in_subtree(below, side / 3) ? side : patch_.twin[side];
  return new_pairs({below, inner}, 1) == 0;
}

std::uint32_t TreeSearch::swap(std::uint32_t below, std::uint32_t side) {
  const std::uint32_t inner = in_subtree(below, side / 3) ? side : patch_.twin[side];
  const std::uint32_t moved = moves_subtree(below) ? inner / 3 : patch_.twin[inner] / 3;
  const Move move{below, inner};
  new_pairs(move, nothing);
  chosen_pairs_ = found_;
  apply(move);
  return moved;
}

}  // namespace ridgecraft::unfold
