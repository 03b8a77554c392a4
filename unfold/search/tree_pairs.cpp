// SPDX-License-Identifier: GPL-3.0-or-later
// The overlapping pairs of the tree search: which there are, and which lie across a fold.
#include <algorithm>
#include <bit>

#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {

void TreeSearch::find_all_pairs() {
  for (std::uint32_t position = 0; position < n_; ++position) {
    const std::uint32_t f = order_[position];
    visit_near(circle_[f].centre, circle_[f].radius, [&](std::uint32_t g) {
      if (at_[g] > position && overlap(flat_[f], flat_[g], tolerance_)) {
        add_pair(f, g);
      }
    });
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

/// Calls use(f, g) for each overlapping pair of a face f in the span and a face g outside it. O(smaller of
/// the span and the overlapping faces, and their pairs).
template <class Use>
void TreeSearch::visit_pairs_across(const Span& moved, Use use) {
  const auto visit = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      if (!in_span(moved, g)) {
        use(f, g);
      }
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (in_span(moved, f)) {
        visit(f);
      }
    }
    return;
  }
  for (std::uint32_t i = 0; i < moved.count; ++i) {
    visit(order_[wrap(moved.first + i)]);
  }
}

/// Overlapping pairs with one face on either side of the fold above `below`: those that its removal may
/// resolve.
std::uint32_t TreeSearch::pairs_across(std::uint32_t below) {
  if (path_pairs_valid_at_[below] == iteration_) {
    return path_pairs_[below];
  }
  std::uint32_t count = 0;
  visit_pairs_across(moved_span(below), [&](std::uint32_t, std::uint32_t) { ++count; });
  path_pairs_[below] = count;
  path_pairs_valid_at_[below] = iteration_;
  return count;
}

std::int64_t TreeSearch::overlaps_added(std::uint32_t below, std::uint32_t side, std::int64_t limit) {
  const std::uint32_t inner = in_subtree(below, side / 3) ? side : patch_.twin[side];
  std::int64_t old = 0;
  if (total_ > 0) {
    visit_pairs_across(moved_span(below), [&](std::uint32_t, std::uint32_t) { ++old; });
  }
  if (limit + old <= 0) {
    return limit;
  }
  return static_cast<std::int64_t>(new_pairs({below, inner}, static_cast<std::uint32_t>(limit + old))) - old;
}

void TreeSearch::drop_pairs_across(std::uint32_t below) {
  dropped_.clear();
  visit_pairs_across(moved_span(below),
                     [&](std::uint32_t f, std::uint32_t g) { dropped_.emplace_back(f, g); });
  for (const auto& [f, g] : dropped_) {
    remove_pair_of(f, g);
    remove_pair_of(g, f);
    --total_;
  }
}

}  // namespace ridgecraft::unfold
