// SPDX-License-Identifier: GPL-3.0-or-later
// The overlapping pairs of the tree search: which there are, and which lie across a fold.
#include <algorithm>
#include <bit>

#include "unfold/tree_search.hpp"

namespace ridgecraft::unfold {

void TreeSearch::find_all_pairs() {
  for (std::uint32_t position = 0; position < n_; ++position) {
    const std::uint32_t f = order_[position];
    sides_.assign(1, 1);
    while (!sides_.empty()) {
      const std::uint32_t node = sides_.back();
      sides_.pop_back();
      if (tree_[node].radius < 0.0 || apart(tree_[node], circle_[f])) {
        continue;
      }
      if (node < tree_.first_leaf()) {
        sides_.push_back(2 * node);
        sides_.push_back(2 * node + 1);
        continue;
      }
      const std::uint32_t block = node - tree_.first_leaf();
      for (std::uint32_t bits = tree_.meeting(block, circle_[f]); bits != 0; bits &= bits - 1) {
        const std::uint32_t other =
            CircleTree::block_size * block + static_cast<std::uint32_t>(std::countr_zero(bits));
        if (other > position && overlap(flat_[f], flat_[order_[other]], tolerance_)) {
          add_pair(f, order_[other]);
        }
      }
    }
  }
}

void TreeSearch::add_pair(std::uint32_t f, std::uint32_t g) {
  for (const auto& [a, b] : {std::pair(f, g), std::pair(g, f)}) {
    if (meets_[a].empty()) {
      bad_at_[a] = static_cast<std::uint32_t>(bad_.size());
      bad_.push_back(a);
    }
    meets_[a].push_back(b);
  }
  ++total_;
}

void TreeSearch::mark_clean(std::uint32_t f) {
  bad_[bad_at_[f]] = bad_.back();
  bad_at_[bad_.back()] = bad_at_[f];
  bad_.pop_back();
  bad_at_[f] = nothing;
}

void TreeSearch::remove_pair_of(std::uint32_t f, std::uint32_t g) {
  auto& list = meets_[f];
  *std::find(list.begin(), list.end(), g) = list.back();
  list.pop_back();
  if (list.empty()) {
    mark_clean(f);
  }
}

/// Overlapping pairs with one face on either side of the fold above `below`: those that its removal may
/// resolve.
std::uint32_t TreeSearch::pairs_across(std::uint32_t below) {
  if (path_pairs_valid_at_[below] == iteration_) {
    return path_pairs_[below];
  }
  std::uint32_t count = 0;
  const Span moved = moved_span(below);
  const auto count_of = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      count += in_span(moved, g) ? 0U : 1U;
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (in_span(moved, f)) {
        count_of(f);
      }
    }
  } else {
    for (std::uint32_t i = 0; i < moved.count; ++i) {
      count_of(order_[wrap(moved.first + i)]);
    }
  }
  path_pairs_[below] = count;
  path_pairs_valid_at_[below] = iteration_;
  return count;
}

void TreeSearch::drop_pairs_across(std::uint32_t below) {
  const Span moved = moved_span(below);
  dropped_.clear();
  const auto collect = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      if (!in_span(moved, g)) {
        dropped_.emplace_back(f, g);
      }
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (in_span(moved, f)) {
        collect(f);
      }
    }
  } else {
    for (std::uint32_t i = 0; i < moved.count; ++i) {
      collect(order_[wrap(moved.first + i)]);
    }
  }
  for (const auto& [f, g] : dropped_) {
    remove_pair_of(f, g);
    remove_pair_of(g, f);
    --total_;
  }
}

}  // namespace ridgecraft::unfold
