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
  return new_pairs({below, inner}, 1, false) == 0;
}

std::uint32_t TreeSearch::swap(std::uint32_t below, std::uint32_t side) {
  const std::uint32_t inner = in_subtree(below, side / 3) ? side : patch_.twin[side];
  const std::uint32_t moved = moves_subtree(below) ? inner / 3 : patch_.twin[inner] / 3;
  apply({below, inner});
  return moved;
}

/// Descends the circle tree twice at once, as new_pairs does, with everything where it is.
void TreeSearch::add_near_across(std::uint32_t below, double reach, std::vector<std::uint32_t>& faces) {
  const Span moved = moved_span(below);
  const std::uint32_t leaf = tree_.first_leaf();
  const std::uint32_t end = moved.first + moved.count;
  const bool wraps = end > n_;
  const auto height = static_cast<std::uint32_t>(std::bit_width(leaf));
  const auto all_moved = [&](std::uint32_t node) {
    const std::uint32_t shift = height - static_cast<std::uint32_t>(std::bit_width(node));
    const std::uint32_t low = (node << shift) - leaf;
    const std::uint32_t high = std::min(low + (1U << shift), n_);
    return wraps ? low >= moved.first || high <= end - n_ : low >= moved.first && high <= end;
  };
  stack_.clear();
  const auto begin = [&](std::uint32_t node) { stack_.emplace_back(node, 1); };
  tree_.cover(moved.first, std::min(end, n_), begin);
  if (wraps) {
    tree_.cover(0, end - n_, begin);
  }
  while (!stack_.empty()) {
    const auto [a, b] = stack_.back();
    stack_.pop_back();
    if (tree_[a].radius < 0.0 || tree_[b].radius < 0.0 ||
        apart({tree_[a].centre, tree_[a].radius + reach}, tree_[b]) || all_moved(b)) {
      continue;
    }
    if (a >= leaf && b >= leaf) {
      faces.push_back(order_[a - leaf]);
      faces.push_back(order_[b - leaf]);
    } else if (b >= leaf || (a < leaf && tree_[a].radius > tree_[b].radius)) {
      stack_.emplace_back(2 * a, b);
      stack_.emplace_back(2 * a + 1, b);
    } else {
      stack_.emplace_back(a, 2 * b);
      stack_.emplace_back(a, 2 * b + 1);
    }
  }
}

}  // namespace ridgecraft::unfold
