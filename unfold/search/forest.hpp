// SPDX-License-Identifier: GPL-3.0-or-later
// A spanning forest of a patch, each tree laid out in a plane of its own, that changes by single moves.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "unfold/patch/patch.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

/// A change of a forest. Both sides given: within one tree a swap; between two trees a branch of one is
/// handed to the other. `opened` alone splits a tree, `closed` alone joins two.
struct Move {
  std::uint32_t opened = no_index;  ///< a side of the fold that becomes a cut
  std::uint32_t closed = no_index;  ///< a side of the cut that becomes a fold

  [[nodiscard]] bool splits() const { return closed == no_index; }
  [[nodiscard]] bool joins() const { return opened == no_index; }
  /// Takes the move back.
  [[nodiscard]] Move inverse() const { return {closed, opened}; }
  friend bool operator==(const Move&, const Move&) = default;
};

/// Trees over the faces of a patch, which need not be connected and must outlive this. Of overlap it knows
/// nothing (search/forest_overlaps.hpp).
///
/// Each tree keeps its faces in a cyclic preorder: the subtree of a face is a cyclic interval of positions
/// that begins at the face's, its complement is one, too, so either half can be the one that moves, and a
/// tree of circles over the positions finds what lies near.
class Forest {
 public:
  /// A cyclic interval of a tree's positions.
  struct Span {
    std::uint32_t tree = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  /// What a move carries, and where.
  struct Carried {
    Span faces;
    std::uint32_t to = no_index;  ///< the tree whose plane it lies in afterwards; nothing: one of its own
    Rigid motion;                 ///< to that plane
  };

  explicit Forest(const Patch& patch);

  /// Takes any forest of folds that holds all frozen sides that its trees can. O(n log n).
  void set_folds(const Folds& folds);
  /// Whether a move keeps a forest: what it closes lies, once what it opens is cut, between two trees, one of
  /// which it has cut.
  [[nodiscard]] bool is_legal(const Move& move) const;
  /// Makes a legal move. Linear in the trees that it changes, but within one tree only in moving numbers.
  void make(const Move& move);

  [[nodiscard]] const Patch& patch() const { return patch_; }
  [[nodiscard]] std::uint32_t face_count() const { return patch_.size(); }
  [[nodiscard]] const Folds& folds() const { return folds_; }
  /// The numbers of its trees, in no order that means anything.
  [[nodiscard]] const std::vector<std::uint32_t>& trees() const { return live_; }
  [[nodiscard]] std::uint32_t tree_of(std::uint32_t face) const { return tree_[face]; }
  /// Larger than any number of a tree.
  [[nodiscard]] std::uint32_t tree_limit() const { return static_cast<std::uint32_t>(trees_.size()); }
  /// The faces of a tree in preorder.
  [[nodiscard]] const std::vector<std::uint32_t>& faces_of(std::uint32_t tree) const {
    return trees_[tree].order;
  }
  [[nodiscard]] std::uint32_t size_of(std::uint32_t tree) const {
    return static_cast<std::uint32_t>(trees_[tree].order.size());
  }
  [[nodiscard]] const CircleTree& circles_of(std::uint32_t tree) const { return trees_[tree].circles; }

  /// A face's corners in its tree's plane.
  [[nodiscard]] const Triangle& flat(std::uint32_t face) const { return flat_[face].corner; }
  [[nodiscard]] const EdgedTriangle& edged_flat(std::uint32_t face) const { return flat_[face]; }
  [[nodiscard]] std::span<const EdgedTriangle> edged_flats() const { return flat_; }
  [[nodiscard]] const Circle& circle(std::uint32_t face) const { return circle_[face]; }
  [[nodiscard]] std::uint32_t position(std::uint32_t face) const { return at_[face]; }
  /// The side of a face to its parent; nothing at a root.
  [[nodiscard]] std::uint32_t side_above(std::uint32_t face) const { return up_[face]; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t face) const { return patch_.twin[up_[face]] / 3; }
  /// Whether a face of the same tree hangs on v, or is v.
  [[nodiscard]] bool in_subtree(std::uint32_t v, std::uint32_t face) const {
    return steps(tree_[v], at_[v], at_[face]) < size_[v];
  }
  [[nodiscard]] Span subtree(std::uint32_t v) const { return {tree_[v], at_[v], size_[v]}; }
  /// Of the two faces at a fold the lower one.
  [[nodiscard]] std::uint32_t below(std::uint32_t fold) const {
    const std::uint32_t f = fold / 3;
    const std::uint32_t twin = patch_.twin[fold];
    return up_[f] == fold || up_[f] == twin ? f : twin / 3;
  }
  /// Folds that may be opened on the way between two faces of one tree, by a side. Valid until the next call.
  /// O(way).
  [[nodiscard]] const std::vector<std::uint32_t>& folds_between(std::uint32_t f, std::uint32_t g);

  /// What a legal move carries: the smaller half of a tree that it swaps within or splits, the branch that it
  /// hands over, the smaller of two trees that it joins.
  [[nodiscard]] Carried carried(const Move& move) const;
  [[nodiscard]] bool in_span(const Span& span, std::uint32_t face) const {
    return tree_[face] == span.tree && steps(span.tree, span.first, at_[face]) < span.count;
  }
  [[nodiscard]] std::uint32_t face_in(const Span& span, std::uint32_t i) const {
    return trees_[span.tree].order[wrap(span.tree, span.first + i)];
  }

  /// Calls use(face) for each face of a tree whose circle comes nearer than `radius` to a point.
  template <class Use>
  void visit_near(std::uint32_t tree, Vec2 centre, double radius, Use use) const;

 private:
  struct Tree {
    std::vector<std::uint32_t> order;
    CircleTree circles;
  };

  [[nodiscard]] std::uint32_t wrap(std::uint32_t tree, std::uint32_t position) const {
    const std::uint32_t n = size_of(tree);
    return position >= n ? position - n : position;
  }
  [[nodiscard]] std::uint32_t steps(std::uint32_t tree, std::uint32_t from, std::uint32_t to) const {
    return to >= from ? to - from : to + size_of(tree) - from;
  }
  [[nodiscard]] Span rest(std::uint32_t v) const {
    const std::uint32_t t = tree_[v];
    return {t, wrap(t, at_[v] + size_[v]), size_of(t) - size_[v]};
  }
  [[nodiscard]] Rigid onto(std::uint32_t side) const;
  [[nodiscard]] std::uint32_t new_tree();
  void drop_tree(std::uint32_t tree);
  void set_fold(std::uint32_t side, std::uint8_t folded);
  [[nodiscard]] std::uint32_t take_out(const Span& span);
  void hang(std::uint32_t face, std::uint32_t up, const Rigid& placed);
  void grow(std::uint32_t face, std::uint32_t more);
  [[nodiscard]] std::uint32_t insert_behind(std::uint32_t parent, std::uint32_t tree);
  void number(std::uint32_t tree);
  void number(std::uint32_t tree, std::uint32_t first, std::uint32_t last);
  void settle(std::uint32_t face, const Rigid& placed);

  const Patch& patch_;
  Folds folds_;
  std::vector<Tree> trees_;
  std::vector<std::uint32_t> live_;     ///< numbers of trees that have faces
  std::vector<std::uint32_t> live_at_;  ///< place of each tree in live_
  std::vector<std::uint32_t> free_;     ///< numbers of trees that have none
  std::vector<std::uint32_t> tree_;     ///< per face
  std::vector<std::uint32_t> at_;       ///< per face: its position in its tree
  std::vector<std::uint32_t> size_;     ///< per face: faces of its subtree
  std::vector<std::uint32_t> up_;       ///< per face: its side to its parent; nothing at a root
  std::vector<Circle> own_circle_;      ///< per face, in its own frame
  std::vector<EdgedTriangle> own_edged_;
  std::vector<Rigid> place_;
  std::vector<EdgedTriangle> flat_;
  std::vector<Circle> circle_;
  std::vector<std::uint32_t> hung_;  ///< what hang() laid out, in preorder
  std::vector<std::uint32_t> way_;
  mutable std::vector<std::uint32_t> open_;
};

template <class Use>
void Forest::visit_near(std::uint32_t tree, Vec2 centre, double radius, Use use) const {
  const Circle circle{centre, radius};
  const CircleTree& circles = trees_[tree].circles;
  open_.assign(1, 1);
  while (!open_.empty()) {
    const std::uint32_t node = open_.back();
    open_.pop_back();
    if (circles[node].radius < 0.0 || apart(circles[node], circle)) {
      continue;
    }
    if (node < circles.first_leaf()) {
      open_.push_back(2 * node);
      open_.push_back(2 * node + 1);
      continue;
    }
    const std::uint32_t block = node - circles.first_leaf();
    for (std::uint32_t met = circles.meeting(block, circle); met != 0; met &= met - 1) {
      use(trees_[tree]
              .order[block * CircleTree::block_size + static_cast<std::uint32_t>(std::countr_zero(met))]);
    }
  }
}

}  // namespace ridgecraft::unfold
