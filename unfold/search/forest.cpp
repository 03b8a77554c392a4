// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/forest.hpp"

#include <algorithm>

namespace ridgecraft::unfold {

Forest::Forest(const Patch& patch)
    : patch_(patch),
      tree_(patch.size()),
      at_(patch.size()),
      size_(patch.size()),
      up_(patch.size()),
      place_(patch.size()),
      flat_(patch.size()),
      circle_(patch.size()) {
  own_circle_.reserve(patch.size());
  own_edged_.reserve(patch.size());
  for (const Triangle& t : patch.shape) {
    own_circle_.push_back(smallest_circle(t[0], t[1], t[2]));
    own_edged_.push_back(edged(t));
  }
}

void Forest::set_folds(const Folds& folds) {
  folds_ = folds;
  trees_.clear();
  live_.clear();
  live_at_.clear();
  free_.clear();
  std::fill(tree_.begin(), tree_.end(), no_index);
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    if (tree_[f] == no_index) {
      const std::uint32_t t = new_tree();
      hang(f, no_index, Rigid{});
      trees_[t].order = hung_;
      number(t);
    }
  }
}

bool Forest::is_legal(const Move& move) const {
  if (move.splits()) {
    return move.opened != no_index;
  }
  const std::uint32_t a = move.closed / 3;
  const std::uint32_t b = patch_.twin[move.closed] / 3;
  if (move.joins()) {
    return tree_[a] != tree_[b];
  }
  const std::uint32_t v = below(move.opened);
  if (tree_[a] != tree_[b]) {
    return tree_[v] == tree_[a] || tree_[v] == tree_[b];
  }
  return tree_[v] == tree_[a] && in_subtree(v, a) != in_subtree(v, b);
}

/// How the frame of a side's tree is carried so that its face lies at the neighbour across the side.
Rigid Forest::onto(std::uint32_t side) const {
  const std::uint32_t twin = patch_.twin[side];
  return place_[twin / 3] * patch_.across[twin] * place_[side / 3].inverse();
}

Forest::Carried Forest::carried(const Move& move) const {
  if (move.joins()) {
    const std::uint32_t twin = patch_.twin[move.closed];
    const std::uint32_t s = tree_[move.closed / 3];
    const std::uint32_t t = tree_[twin / 3];
    const bool first_moves = size_of(s) <= size_of(t);
    return {{first_moves ? s : t, 0, first_moves ? size_of(s) : size_of(t)},
            first_moves ? t : s,
            onto(first_moves ? move.closed : twin)};
  }
  const std::uint32_t v = below(move.opened);
  // Of halves that are equal the one at the side that is named: the move back then restores the tree's
  // number.
  const std::uint32_t whole = size_of(tree_[v]);
  const bool lower_is_smaller = 2 * size_[v] < whole || (2 * size_[v] == whole && move.opened / 3 == v);
  if (move.splits()) {
    return {lower_is_smaller ? subtree(v) : rest(v), no_index, Rigid{}};
  }
  // The side of `closed` that lies in the half that moves.
  std::uint32_t side = move.closed;
  const std::uint32_t twin = patch_.twin[side];
  const bool hands_over = tree_[side / 3] != tree_[twin / 3];
  if (hands_over ? tree_[side / 3] != tree_[v] : in_subtree(v, side / 3) != lower_is_smaller) {
    side = twin;
  }
  return {in_subtree(v, side / 3) ? subtree(v) : rest(v), tree_[patch_.twin[side] / 3], onto(side)};
}

void Forest::make(const Move& move) {
  const Carried what = carried(move);
  const std::uint32_t t = what.faces.tree;
  // The face by which what moves hangs in its new tree, and its side there.
  std::uint32_t up = no_index;
  std::uint32_t root = no_index;
  if (move.splits()) {
    const std::uint32_t v = below(move.opened);
    root = in_span(what.faces, v) ? v : parent(v);
  } else {
    up = in_span(what.faces, move.closed / 3) ? move.closed : patch_.twin[move.closed];
    root = up / 3;
  }
  if (move.opened != no_index) {
    const std::uint32_t v = below(move.opened);
    if (in_span(what.faces, v)) {
      grow(parent(v), 0U - what.faces.count);
    } else {
      up_[v] = no_index;  // its subtree stays and is a tree of its own
    }
    set_fold(move.opened, 0);
  }
  if (move.closed != no_index) {
    set_fold(move.closed, 1);
  }
  const std::uint32_t taken_at = take_out(what.faces);
  const Rigid placed =
      up == no_index ? Rigid{} : place_[patch_.twin[up] / 3] * patch_.across[patch_.twin[up]];
  if (up == no_index) {
    const std::uint32_t fresh = new_tree();
    hang(root, no_index, placed);
    trees_[fresh].order = hung_;
    number(fresh);
    number(t);
    return;
  }
  hang(root, up, placed);
  const std::uint32_t q = patch_.twin[up] / 3;
  grow(q, what.faces.count);
  const std::uint32_t put_at = insert_behind(q, what.to);
  if (what.to == t && taken_at != no_index) {
    number(t, std::min(taken_at, put_at), std::max(taken_at, put_at) + what.faces.count);
    return;
  }
  number(what.to);
  if (what.to == t) {
    return;
  }
  if (trees_[t].order.empty()) {
    drop_tree(t);
  } else {
    number(t);
  }
}

/// Takes an interval out of its tree's order; what stays begins with its root. The first position that
/// changes, nothing where all may.
std::uint32_t Forest::take_out(const Span& span) {
  std::vector<std::uint32_t>& order = trees_[span.tree].order;
  const auto n = static_cast<std::uint32_t>(order.size());
  if (span.first > 0 && span.first + span.count <= n) {
    order.erase(order.begin() + span.first, order.begin() + span.first + span.count);
    return span.first;
  }
  const std::uint32_t kept = wrap(span.tree, span.first + span.count);
  std::rotate(order.begin(), order.begin() + kept, order.end());
  order.resize(n - span.count);
  return no_index;
}

/// The subtree of a face, and with it those that it lies in, have so many faces more.
void Forest::grow(std::uint32_t face, std::uint32_t more) {
  size_[face] += more;
  while (up_[face] != no_index) {
    face = parent(face);
    size_[face] += more;
  }
}

/// Puts what hang() laid out behind a face, and says where.
std::uint32_t Forest::insert_behind(std::uint32_t parent, std::uint32_t tree) {
  std::vector<std::uint32_t>& order = trees_[tree].order;
  const auto at = std::find(order.begin(), order.end(), parent) + 1;
  const auto position = static_cast<std::uint32_t>(at - order.begin());
  order.insert(at, hung_.begin(), hung_.end());
  return position;
}

/// Lays out what hangs together at a face without its side `up`, in preorder, and counts its subtrees.
void Forest::hang(std::uint32_t face, std::uint32_t up, const Rigid& placed) {
  hung_.clear();
  settle(face, placed);
  up_[face] = up;
  open_.assign(1, face);
  while (!open_.empty()) {
    const std::uint32_t f = open_.back();
    open_.pop_back();
    hung_.push_back(f);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (folds_[side] != 0 && side != up_[f]) {
        const std::uint32_t twin = patch_.twin[side];
        up_[twin / 3] = twin;
        settle(twin / 3, place_[f] * patch_.across[side]);
        open_.push_back(twin / 3);
      }
    }
    size_[f] = 1;
  }
  for (std::size_t i = hung_.size(); i-- > 1;) {
    size_[parent(hung_[i])] += size_[hung_[i]];
  }
}

/// Positions and circles of a tree whose order is right.
void Forest::number(std::uint32_t tree) {
  number(tree, 0, size_of(tree));
}

/// The same where none but these positions have changed.
void Forest::number(std::uint32_t tree, std::uint32_t first, std::uint32_t last) {
  const std::vector<std::uint32_t>& order = trees_[tree].order;
  CircleTree& circles = trees_[tree].circles;
  if (circles.size() != order.size()) {
    circles.reset(size_of(tree));
    first = 0;
    last = size_of(tree);
  }
  for (std::uint32_t i = first; i < last; ++i) {
    const std::uint32_t f = order[i];
    tree_[f] = tree;
    at_[f] = i;
    circles.set(i, circle_[f]);
  }
  circles.renew(first, last);
}

void Forest::settle(std::uint32_t face, const Rigid& placed) {
  place_[face] = placed;
  flat_[face] = moved(own_edged_[face], placed);
  circle_[face] = {placed(own_circle_[face].centre), own_circle_[face].radius};
}

std::uint32_t Forest::new_tree() {
  std::uint32_t t = 0;
  if (free_.empty()) {
    t = static_cast<std::uint32_t>(trees_.size());
    trees_.emplace_back();
    live_at_.push_back(no_index);
  } else {
    t = free_.back();
    free_.pop_back();
  }
  live_at_[t] = static_cast<std::uint32_t>(live_.size());
  live_.push_back(t);
  return t;
}

void Forest::drop_tree(std::uint32_t tree) {
  live_[live_at_[tree]] = live_.back();
  live_at_[live_.back()] = live_at_[tree];
  live_.pop_back();
  live_at_[tree] = no_index;
  free_.push_back(tree);
}

void Forest::set_fold(std::uint32_t side, std::uint8_t folded) {
  folds_[side] = folds_[patch_.twin[side]] = folded;
}

const std::vector<std::uint32_t>& Forest::folds_between(std::uint32_t f, std::uint32_t g) {
  way_.clear();
  const auto climb = [this](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t v = from; !in_subtree(v, to); v = parent(v)) {
      if (patch_.frozen[up_[v]] == 0) {
        way_.push_back(up_[v]);
      }
    }
  };
  climb(f, g);
  climb(g, f);
  return way_;
}

}  // namespace ridgecraft::unfold
