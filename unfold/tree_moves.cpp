// SPDX-License-Identifier: GPL-3.0-or-later
// What a move of the tree search would meet, and making it.
#include <algorithm>
#include <bit>

#include "mesh/error.hpp"
#include "unfold/tree_search.hpp"

namespace ridgecraft::unfold {

/// How the smaller side moves: the subtree against the rest, or the rest against the subtree.
Rigid TreeSearch::motion(const Move& move) const {
  const std::uint32_t side = moves_subtree(move.below) ? move.side : patch_.twin[move.side];
  const std::uint32_t twin = patch_.twin[side];
  return place_[twin / 3] * patch_.across[twin] * place_[side / 3].inverse();
}

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
      } else if (node - tree_.first_leaf() > position) {
        const std::uint32_t g = order_[node - tree_.first_leaf()];
        if (overlap(flat_[f], flat_[g], tolerance_)) {
          add_pair(f, g);
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

/// Pairs that the move would make, counted up to the limit; collected in found_ on request.
///
/// Descends the circle tree twice at once: the circles of the moved side, carried along by the motion,
/// against those of the side that stays (Gottschalk, Lin, Manocha 1996, with circles for boxes since they
/// needn't be turned).
std::uint32_t TreeSearch::new_pairs(const Move& move, std::uint32_t limit, bool collect) {
  const Rigid motion = this->motion(move);
  const Span moved = moved_span(move.below);
  const std::uint32_t leaf = tree_.first_leaf();
  const std::uint32_t end = moved.first + moved.count;
  const bool wraps = end > n_;
  const auto height = static_cast<std::uint32_t>(std::bit_width(leaf));
  // Positions below a node that all belong to the moved side can't be met.
  const auto all_moved = [&](std::uint32_t node) {
    const std::uint32_t shift = height - static_cast<std::uint32_t>(std::bit_width(node));
    const std::uint32_t low = (node << shift) - leaf;
    const std::uint32_t high = std::min(low + (1U << shift), n_);
    return wraps ? low >= moved.first || high <= end - n_ : low >= moved.first && high <= end;
  };
  const auto carried = [&](std::uint32_t node) {
    return Circle{motion(tree_[node].centre), tree_[node].radius};
  };
  ++evaluation_;
  found_.clear();
  stack_.clear();
  std::uint32_t count = 0;
  const auto test = [&](std::uint32_t f, std::uint32_t g) {
    if (moved_in_[f] != evaluation_) {
      moved_in_[f] = evaluation_;
      moved_[f] = {motion(flat_[f][0]), motion(flat_[f][1]), motion(flat_[f][2])};
    }
    if (overlap(moved_[f], flat_[g], tolerance_)) {
      ++count;
      if (collect) {
        found_.emplace_back(f, g);
      }
    }
  };
  const auto begin = [&](std::uint32_t node) { stack_.emplace_back(node, 1); };
  tree_.cover(moved.first, std::min(end, n_), begin);
  if (wraps) {
    tree_.cover(0, end - n_, begin);
  }
  while (!stack_.empty() && count < limit) {
    auto [a, b] = stack_.back();
    stack_.pop_back();
    const Circle circle = carried(a);
    if (tree_[b].radius < 0.0 || apart(circle, tree_[b]) || all_moved(b)) {
      continue;
    }
    if (a >= leaf && b >= leaf) {
      test(order_[a - leaf], order_[b - leaf]);
    } else if (b >= leaf || (a < leaf && circle.radius > tree_[b].radius)) {
      stack_.emplace_back(2 * a, b);
      stack_.emplace_back(2 * a + 1, b);
    } else {
      stack_.emplace_back(a, 2 * b);
      stack_.emplace_back(a, 2 * b + 1);
    }
  }
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

void TreeSearch::apply(const Move& move) {
  new_pairs(move, nothing, true);
  drop_pairs_across(move.below);
  const std::uint32_t removed = up_[move.below];
  folds_[removed] = folds_[patch_.twin[removed]] = 0;
  folds_[move.side] = folds_[patch_.twin[move.side]] = 1;
  if (moves_subtree(move.below)) {
    hang_subtree(move);
  } else {
    hang_rest(move);
  }
  for (const auto& [f, g] : found_) {
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
  for (unsigned k = 0; k < 3; ++k) {
    flat_[face][k] = placed(patch_.shape[face][k]);
  }
  circle_[face] = {placed(own_circle_[face].centre), own_circle_[face].radius};
}

/// Brings the circle tree up to date over a cyclic interval of positions.
void TreeSearch::renew(std::uint32_t first, std::uint32_t count) {
  const auto interval = [this](std::uint32_t low, std::uint32_t high) {
    for (std::uint32_t position = low; position < high; ++position) {
      tree_.set_leaf(position, circle_[order_[position]]);
    }
    tree_.renew(low, high);
  };
  interval(first, std::min(first + count, n_));
  if (first + count > n_) {
    interval(0, first + count - n_);
  }
}

}  // namespace ridgecraft::unfold
