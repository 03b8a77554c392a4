// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

RootedNet::RootedNet(const Patch& patch)
    : patch_(patch),
      n_(patch.size()),
      order_(n_),
      at_(n_),
      size_(n_),
      up_(n_),
      place_(n_),
      flat_(n_),
      circle_(n_) {
  own_circle_.reserve(n_);
  own_edged_.reserve(n_);
  for (const Triangle& t : patch.shape) {
    own_circle_.push_back(smallest_circle(t[0], t[1], t[2]));
    own_edged_.push_back(edged(t));
  }
}

void RootedNet::set_tree(const Folds& folds) {
  folds_ = folds;
  tree_.reset(n_);
  traverse(0, nothing, 0, Rigid{});
  renew(0, n_);
}

const std::vector<std::uint32_t>& RootedNet::removable_between(std::uint32_t f, std::uint32_t g) {
  removable_.clear();
  const auto climb = [this](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t v = from; !in_subtree(v, to); v = parent(v)) {
      if (patch_.frozen[up_[v]] == 0) {
        removable_.push_back(v);
      }
    }
  };
  climb(f, g);
  climb(g, f);
  return removable_;
}

/// The smaller half against the other: the subtree against the rest, or the rest against the subtree.
Rigid RootedNet::motion(std::uint32_t below, std::uint32_t side) const {
  const std::uint32_t within = inner(below, side);
  const std::uint32_t moving = moves_subtree(below) ? within : patch_.twin[within];
  const std::uint32_t twin = patch_.twin[moving];
  return place_[twin / 3] * patch_.across[twin] * place_[moving / 3].inverse();
}

std::uint32_t RootedNet::swap(std::uint32_t below, std::uint32_t side) {
  const std::uint32_t within = inner(below, side);
  const std::uint32_t twin = patch_.twin[within];
  const std::uint32_t removed = up_[below];
  folds_[removed] = folds_[patch_.twin[removed]] = 0;
  folds_[within] = folds_[twin] = 1;
  if (moves_subtree(below)) {
    hang_subtree(below, within);
    return within / 3;
  }
  hang_rest(below, within);
  return twin / 3;
}

/// The subtree's interval of the cyclic order goes behind its new parent.
void RootedNet::hang_subtree(std::uint32_t v, std::uint32_t side) {
  const std::uint32_t twin = patch_.twin[side];
  const std::uint32_t u = twin / 3;
  const std::uint32_t old_parent = parent(v);
  const std::uint32_t s = size_[v];
  for (std::uint32_t q = old_parent; !in_subtree(q, u); q = parent(q)) {
    size_[q] -= s;
  }
  for (std::uint32_t q = u; !in_subtree(q, old_parent); q = parent(q)) {
    size_[q] += s;
  }
  lay_behind(u, side, at_[v], s);
}

/// The rest is the smaller side: the subtree stays where it is and becomes the root's, the rest hangs below
/// it.
void RootedNet::hang_rest(std::uint32_t v, std::uint32_t side) {
  const std::uint32_t x = side / 3;
  const std::uint32_t s = size_[v];
  const std::uint32_t rest = n_ - s;
  for (std::uint32_t q = x; q != v; q = parent(q)) {
    size_[q] += rest;
  }
  size_[v] = n_;
  up_[v] = nothing;
  lay_behind(x, patch_.twin[side], wrap(at_[v] + s), rest);
}

/// Takes the `moved` faces from position `hole` on out of the order and lays them behind face q, where they
/// hang over their side `up`; what lies between closes up, on whichever way round is shorter.
void RootedNet::lay_behind(std::uint32_t q, std::uint32_t up, std::uint32_t hole, std::uint32_t moved) {
  const std::uint32_t kept = wrap(hole + moved);
  const std::uint32_t until_q = steps(kept, at_[q]) + 1;
  const std::uint32_t beyond_q = n_ - moved - until_q;
  const Rigid placed = place_[q] * patch_.across[patch_.twin[up]];
  if (until_q <= beyond_q) {
    shift_back(kept, until_q, moved);
    traverse(up / 3, up, wrap(hole + until_q), placed);
    renew(hole, moved + until_q);
  } else {
    const std::uint32_t behind = wrap(at_[q] + 1);
    shift_forward(behind, beyond_q, moved);
    traverse(up / 3, up, behind, placed);
    renew(behind, moved + beyond_q);
  }
}

void RootedNet::shift_back(std::uint32_t first, std::uint32_t count, std::uint32_t by) {
  std::uint32_t from = first;
  std::uint32_t to = first >= by ? first - by : first + n_ - by;
  for (std::uint32_t i = 0; i < count; ++i) {
    order_[to] = order_[from];
    at_[order_[to]] = to;
    from = wrap(from + 1);
    to = wrap(to + 1);
  }
}

void RootedNet::shift_forward(std::uint32_t first, std::uint32_t count, std::uint32_t by) {
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
void RootedNet::traverse(std::uint32_t start, std::uint32_t up, std::uint32_t position, const Rigid& placed) {
  settle(start, placed);
  up_[start] = up;
  open_.assign(1, start);
  std::uint32_t last = position;
  std::uint32_t count = 0;
  while (!open_.empty()) {
    const std::uint32_t f = open_.back();
    open_.pop_back();
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
        open_.push_back(twin / 3);
      }
    }
  }
  for (; count > 1; --count) {
    const std::uint32_t f = order_[last];
    size_[patch_.twin[up_[f]] / 3] += size_[f];
    last = last == 0 ? n_ - 1 : last - 1;
  }
}

void RootedNet::settle(std::uint32_t face, const Rigid& placed) {
  place_[face] = placed;
  flat_[face] = moved(own_edged_[face], placed);
  circle_[face] = {placed(own_circle_[face].centre), own_circle_[face].radius};
}

/// Brings the circle tree up to date over a cyclic interval of positions.
void RootedNet::renew(std::uint32_t first, std::uint32_t count) {
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
