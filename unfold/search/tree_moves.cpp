// SPDX-License-Identifier: GPL-3.0-or-later
// Making a move of the tree search.
#include <algorithm>

#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {

void TreeSearch::apply(const Move& move) {
  drop_pairs_across(move.below);
  const std::uint32_t removed = up_[move.below];
  folds_[removed] = folds_[patch_.twin[removed]] = 0;
  folds_[move.side] = folds_[patch_.twin[move.side]] = 1;
  if (moves_subtree(move.below)) {
    hang_subtree(move);
  } else {
    hang_rest(move);
  }
  for (const auto& [f, g] : chosen_pairs_) {
    add_pair(f, g);
  }
}

/// Cuts the subtree's interval out of the cyclic order and puts it behind its new parent; what lies between
/// closes up, on whichever way round is shorter.
void TreeSearch::hang_subtree(const Move& move) {
  const std::uint32_t v = move.below;
  const std::uint32_t twin = patch_.twin[move.side];
  const std::uint32_t u = twin / 3;
  const std::uint32_t old_parent = patch_.twin[up_[v]] / 3;
  const std::uint32_t s = size_[v];
  for (std::uint32_t q = old_parent; !in_subtree(q, u); q = patch_.twin[up_[q]] / 3) {
    size_[q] -= s;
  }
  for (std::uint32_t q = u; !in_subtree(q, old_parent); q = patch_.twin[up_[q]] / 3) {
    size_[q] += s;
  }
  const std::uint32_t first = at_[v];
  const std::uint32_t after = wrap(first + s);
  const std::uint32_t until_u = steps(after, at_[u]) + 1;
  const std::uint32_t beyond_u = n_ - s - until_u;
  const Rigid placed = place_[u] * patch_.across[twin];
  if (until_u <= beyond_u) {
    shift_back(after, until_u, s);
    traverse(move.side / 3, move.side, wrap(first + until_u), placed);
    renew(first, s + until_u);
  } else {
    const std::uint32_t behind = wrap(at_[u] + 1);
    shift_forward(behind, beyond_u, s);
    traverse(move.side / 3, move.side, behind, placed);
    renew(behind, s + beyond_u);
  }
}

/// The rest is the smaller side: the subtree stays where it is and becomes the root's, the rest hangs below
/// it.
void TreeSearch::hang_rest(const Move& move) {
  const std::uint32_t v = move.below;
  const std::uint32_t x = move.side / 3;
  const std::uint32_t twin = patch_.twin[move.side];
  const std::uint32_t s = size_[v];
  const std::uint32_t rest = n_ - s;
  const std::uint32_t until_x = steps(at_[v], at_[x]) + 1;
  const std::uint32_t beyond_x = s - until_x;
  for (std::uint32_t q = x; q != v; q = patch_.twin[up_[q]] / 3) {
    size_[q] += rest;
  }
  size_[v] = n_;
  up_[v] = nothing;
  const Rigid placed = place_[x] * patch_.across[move.side];
  if (until_x <= beyond_x) {
    const std::uint32_t first = wrap(at_[v] + s);
    shift_back(at_[v], until_x, rest);
    traverse(twin / 3, twin, wrap(first + until_x), placed);
    renew(first, rest + until_x);
  } else {
    const std::uint32_t behind = wrap(at_[x] + 1);
    shift_forward(behind, beyond_x, rest);
    traverse(twin / 3, twin, behind, placed);
    renew(behind, rest + beyond_x);
  }
}

void TreeSearch::shift_back(std::uint32_t first, std::uint32_t count, std::uint32_t by) {
  std::uint32_t from = first;
  std::uint32_t to = first >= by ? first - by : first + n_ - by;
  for (std::uint32_t i = 0; i < count; ++i) {
    order_[to] = order_[from];
    at_[order_[to]] = to;
    from = wrap(from + 1);
    to = wrap(to + 1);
  }
}

void TreeSearch::shift_forward(std::uint32_t first, std::uint32_t count, std::uint32_t by) {
  std::uint32_t from = wrap(first + count);
  std::uint32_t to = wrap(from + by);
  for (std::uint32_t i = 0; i < count; ++i) {
    from = from == 0 ? n_ - 1 : from - 1;
    to = to == 0 ? n_ - 1 : to - 1;
    order_[to] = order_[from];
    at_[order_[to]] = to;
  }
}

/// Numbers and places the faces that hang together at `start` without the fold `up`, in preorder from
/// `position` on.
void TreeSearch::traverse(std::uint32_t start, std::uint32_t up, std::uint32_t position,
                          const Rigid& placed) {
  settle(start, placed);
  up_[start] = up;
  sides_.assign(1, start);
  std::uint32_t last = position;
  std::uint32_t count = 0;
  while (!sides_.empty()) {
    const std::uint32_t f = sides_.back();
    sides_.pop_back();
    last = wrap(position + count);
    ++count;
    order_[last] = f;
    at_[f] = last;
    size_[f] = 1;
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (folds_[side] != 0 && side != up_[f]) {
        const std::uint32_t twin = patch_.twin[side];
        up_[twin / 3] = twin;
        settle(twin / 3, place_[f] * patch_.across[side]);
        sides_.push_back(twin / 3);
      }
    }
  }
  for (; count > 1; --count) {
    const std::uint32_t f = order_[last];
    size_[patch_.twin[up_[f]] / 3] += size_[f];
    last = last == 0 ? n_ - 1 : last - 1;
  }
}

void TreeSearch::settle(std::uint32_t face, const Rigid& placed) {
  place_[face] = placed;
  flat_[face] = moved(own_edged_[face], placed);
  circle_[face] = {placed(own_circle_[face].centre), own_circle_[face].radius};
}

/// Brings the circle tree up to date over a cyclic interval of positions.
void TreeSearch::renew(std::uint32_t first, std::uint32_t count) {
  const auto interval = [this](std::uint32_t low, std::uint32_t high) {
    for (std::uint32_t position = low; position < high; ++position) {
      tree_.set(position, circle_[order_[position]]);
    }
    tree_.renew(low, high);
  };
  interval(first, std::min(first + count, n_));
  if (first + count > n_) {
    interval(0, first + count - n_);
  }
}

}  // namespace ridgecraft::unfold
