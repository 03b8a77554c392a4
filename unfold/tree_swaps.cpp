// SPDX-License-Identifier: GPL-3.0-or-later
// Single swaps of a tree, and what comes near across a fold: for searches that have overlap behind them.
#include <bit>

#include "unfold/tree_search.hpp"

namespace ridgecraft::unfold {

std::vector<std::uint32_t> TreeSearch::removable_between(std::uint32_t f, std::uint32_t g) {
  find_path(f, g);
  std::vector<std::uint32_t> below;
  below.reserve(path_.size());
  for (const Arc& arc : path_) {
    below.push_back(arc.below);
  }
  return below;
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

void TreeSearch::add_near_across(std::uint32_t below, double reach, std::vector<std::uint32_t>& faces) {
  constexpr std::uint32_t size = CircleTree::block_size;
  const Span moved = moved_span(below);
  const std::uint32_t leaf = tree_.first_leaf();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;  // blocks of the side that moves, nodes
  const auto begin = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t block = first / size; block * size < last; ++block) {
      open.emplace_back(block, 1);
    }
  };
  begin(moved.first, std::min(moved.first + moved.count, n_));
  begin(0, moved.first + moved.count > n_ ? moved.first + moved.count - n_ : 0);
  const auto inside = [&](std::uint32_t position) { return steps(moved.first, position) < moved.count; };
  const auto test_blocks = [&](std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t i = a * size; i < std::min(a * size + size, n_); ++i) {
      if (!inside(i)) {
        continue;
      }
      Circle circle = tree_.circle(i);
      circle.radius += reach;
      for (std::uint32_t met = tree_.meeting(b, circle); met != 0; met &= met - 1) {
        const std::uint32_t j = b * size + static_cast<std::uint32_t>(std::countr_zero(met));
        if (!inside(j)) {
          faces.push_back(order_[i]);
          faces.push_back(order_[j]);
        }
      }
    }
  };
  while (!open.empty()) {
    const auto [block, node] = open.back();
    open.pop_back();
    const Circle& here = tree_[leaf + block];
    if (tree_[node].radius < 0.0 || apart({here.centre, here.radius + reach}, tree_[node])) {
      continue;
    }
    if (node >= leaf) {
      test_blocks(block, node - leaf);
    } else {
      open.emplace_back(block, 2 * node);
      open.emplace_back(block, 2 * node + 1);
    }
  }
}

}  // namespace ridgecraft::unfold
