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

namespace {

/// Bits of a block's positions that lie in first .. last-1.
std::uint32_t bits_within(std::uint32_t block, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t size = CircleTree::block_size;
  const std::uint32_t begin = block * size;
  const std::uint32_t low = std::clamp(first, begin, begin + size) - begin;
  const std::uint32_t high = std::clamp(last, begin, begin + size) - begin;
  return (1U << high) - (1U << low);
}

}  // namespace

/// The question what a move would meet, asked of the circle tree twice at once: circles of the side that
/// moves, carried along, against those of the side that stays (Gottschalk, Lin, Manocha 1996, with circles
/// for boxes since they needn't be turned).
class TreeSearch::Descent {
 public:
  Descent(TreeSearch& search, const Rigid& motion, const Span& moved, std::uint32_t limit)
      : s_(search),
        tree_(search.tree_),
        motion_(motion),
        first_(moved.first),
        last_(std::min(moved.first + moved.count, search.n_)),
        wrapped_(moved.first + moved.count - last_),
        leaf_(tree_.first_leaf()),
        height_(static_cast<std::uint32_t>(std::bit_width(leaf_))),
        limit_(limit) {}

  /// The number of pairs, or the limit when it is reached.
  std::uint32_t run() {
    interval(first_, last_);
    interval(0, wrapped_);
    s_.meetings_.clear();
    return count_;
  }

 private:
  static constexpr std::uint32_t size = CircleTree::block_size;

  /// Everything below the node moves, so nothing there can be met.
  [[nodiscard]] bool all_moved(std::uint32_t node) const {
    const std::uint32_t shift = height_ - static_cast<std::uint32_t>(std::bit_width(node));
    const std::uint32_t low = ((node << shift) - leaf_) * size;
    const std::uint32_t high = std::min(low + (size << shift), s_.n_);
    return (low >= first_ && high <= last_) || high <= wrapped_;
  }

  [[nodiscard]] Circle carried(std::uint32_t node) const {
    return {motion_(tree_[node].centre), tree_[node].radius};
  }

  /// What the faces at positions first .. last-1 meet: whole blocks through the tree, the rest block by
  /// block.
  void interval(std::uint32_t first, std::uint32_t last) {
    if (first >= last || count_ == limit_) {
      return;
    }
    const std::uint32_t head = (first + size - 1) / size;
    const std::uint32_t tail = last / size;
    if (head > tail) {
      part_of_block(first / size, first, last);
      return;
    }
    if (first % size != 0) {
      part_of_block(first / size, first, head * size);
    }
    if (last % size != 0 && count_ < limit_) {
      part_of_block(tail, tail * size, last);
    }
    tree_.cover(head, tail, [this](std::uint32_t node) { meet(node, motion_(tree_[node].centre), 1); });
    descend(~0U);
  }

  void part_of_block(std::uint32_t block, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t bits = bits_within(block, first, last);
    Circle all;
    for (std::uint32_t position = first; position < last; ++position) {
      all = around(all, tree_.circle(position));
    }
    // Stands for the block's node, with a circle of its own.
    part_radius_ = all.radius;
    meet_as(leaf_ + block, motion_(all.centre), part_radius_, 1);
    descend(bits);
    part_radius_ = -1.0;
  }

  void meet(std::uint32_t a, Vec2 centre, std::uint32_t b) { meet_as(a, centre, tree_[a].radius, b); }

  void meet_as(std::uint32_t a, Vec2 centre, double radius, std::uint32_t b) {
    const Circle& other = tree_[b];
    if (radius >= 0.0 && other.radius >= 0.0 && !apart({centre, radius}, other) && !all_moved(b)) {
      s_.meetings_.push_back({a, b, centre});
    }
  }

  /// Works off the meetings. `bits`: which faces of a block that moves count.
  void descend(std::uint32_t bits) {
    auto& meetings = s_.meetings_;
    while (!meetings.empty() && count_ < limit_) {
      const Meeting at = meetings.back();
      meetings.pop_back();
      const double radius = part_radius_ < 0.0 ? tree_[at.a].radius : part_radius_;
      if (at.a >= leaf_ && at.b >= leaf_) {
        blocks(at.a - leaf_, bits, at.b - leaf_);
      } else if (at.b >= leaf_ || (at.a < leaf_ && radius > tree_[at.b].radius)) {
        meet(2 * at.a, motion_(tree_[2 * at.a].centre), at.b);
        meet(2 * at.a + 1, motion_(tree_[2 * at.a + 1].centre), at.b);
      } else {
        meet_as(at.a, at.centre, radius, 2 * at.b);
        meet_as(at.a, at.centre, radius, 2 * at.b + 1);
      }
    }
    meetings.clear();
  }

  void blocks(std::uint32_t a, std::uint32_t bits, std::uint32_t b) {
    const std::uint32_t stays = ~(bits_within(b, first_, last_) | bits_within(b, 0, wrapped_));
    const Circle& around_b = tree_[leaf_ + b];
    for (std::uint32_t i = a * size; i < std::min(a * size + size, s_.n_); ++i) {
      if (((bits >> (i - a * size)) & 1U) == 0) {
        continue;
      }
      Circle circle = tree_.circle(i);
      circle.centre = motion_(circle.centre);
      if (apart(circle, around_b)) {
        continue;
      }
      for (std::uint32_t met = tree_.meeting(b, circle) & stays; met != 0; met &= met - 1) {
        test(s_.order_[i], s_.order_[b * size + static_cast<std::uint32_t>(std::countr_zero(met))]);
        if (count_ == limit_) {
          return;
        }
      }
    }
  }

  void test(std::uint32_t f, std::uint32_t g) {
    if (s_.moved_in_[f] != s_.evaluation_) {
      s_.moved_in_[f] = s_.evaluation_;
      s_.moved_[f] = moved(s_.flat_[f], motion_);
    }
    if (overlap(s_.moved_[f], s_.flat_[g], s_.tolerance_)) {
      ++count_;
      s_.found_.emplace_back(f, g);
    }
  }

  TreeSearch& s_;
  const CircleTree& tree_;
  const Rigid motion_;
  const std::uint32_t first_, last_, wrapped_;  ///< positions first .. last-1 and 0 .. wrapped-1 move
  const std::uint32_t leaf_, height_, limit_;
  std::uint32_t count_ = 0;
  double part_radius_ = -1.0;
};

/// Pairs that the move would make, collected in found_ up to the limit.
std::uint32_t TreeSearch::new_pairs(const Move& move, std::uint32_t limit) {
  ++evaluation_;
  found_.clear();
  return Descent(*this, motion(move), moved_span(move.below), limit).run();
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
