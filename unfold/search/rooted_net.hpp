// SPDX-License-Identifier: GPL-3.0-or-later
// A spanning tree of faces, hung from a root and laid out in the plane, that changes by one fold at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "unfold/patch/patch.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

/// One tree over a patch, the places of its faces, and the swap that changes it: the fold above a face
/// `below` becomes a cut, and `side`, a side of a cut between the two halves that this leaves, becomes a
/// fold. The patch must be connected and outlive the net. Of overlap it knows nothing (overlap_pairs.hpp,
/// overlap_pairs.hpp).
///
/// The tree is kept as one flag per side and, for the traversal from a root, a cyclic preorder: the subtree
/// of v is a cyclic interval of positions that begins at v's, its complement is one cyclic interval too, so
/// either half can be the one that moves, whichever is smaller, and a circle tree over the positions answers
/// what lies near it.
class RootedNet {
 public:
  /// A cyclic interval of positions.
  struct Span {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  explicit RootedNet(const Patch& patch);

  /// Sets the tree; it must span the patch. O(n log n).
  void set_tree(const Folds& folds);
  /// Makes a swap and returns the face below the new fold, whose subtree is the half that moved: what takes
  /// the swap back is swap(that face, the side that was above `below`). O(positions between the old place and
  /// the new one + smaller half + depth).
  std::uint32_t swap(std::uint32_t below, std::uint32_t side);

  [[nodiscard]] const Patch& patch() const { return patch_; }
  [[nodiscard]] std::uint32_t size() const { return n_; }
  [[nodiscard]] const Folds& folds() const { return folds_; }
  /// A face's corners in the plane.
  [[nodiscard]] const Triangle& flat(std::uint32_t face) const { return flat_[face].corner; }
  [[nodiscard]] const EdgedTriangle& edged_flat(std::uint32_t face) const { return flat_[face]; }
  [[nodiscard]] std::span<const EdgedTriangle> edged_flats() const { return flat_; }
  /// The smallest circle around it.
  [[nodiscard]] const Circle& circle(std::uint32_t face) const { return circle_[face]; }

  /// The side of `below` to its parent; nothing at the root.
  [[nodiscard]] std::uint32_t side_above(std::uint32_t below) const { return up_[below]; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t below) const { return patch_.twin[up_[below]] / 3; }
  [[nodiscard]] bool in_subtree(std::uint32_t v, std::uint32_t x) const {
    return steps(at_[v], at_[x]) < size_[v];
  }
  /// Faces of the smaller half without the fold above `below`.
  [[nodiscard]] std::uint32_t smaller_half(std::uint32_t below) const {
    return std::min(size_[below], n_ - size_[below]);
  }
  /// Folds that may be removed on the tree path between two faces, each named by the face below it: only
  /// removing one of them changes how the two lie to each other. Valid until the next call. O(path).
  [[nodiscard]] const std::vector<std::uint32_t>& removable_between(std::uint32_t f, std::uint32_t g);

  /// Whether a swap of the fold above v moves v's subtree, the smaller half, or all the rest.
  [[nodiscard]] bool moves_subtree(std::uint32_t v) const { return 2 * size_[v] <= n_; }
  /// Positions of the half that such a swap moves.
  [[nodiscard]] Span moved_span(std::uint32_t v) const {
    return moves_subtree(v) ? Span{at_[v], size_[v]} : Span{wrap(at_[v] + size_[v]), n_ - size_[v]};
  }
  /// How it moves.
  [[nodiscard]] Rigid motion(std::uint32_t below, std::uint32_t side) const;
  [[nodiscard]] std::uint32_t position(std::uint32_t face) const { return at_[face]; }
  /// The faces by their positions.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] std::uint32_t face_at(std::uint32_t position) const { return order_[position]; }
  /// The face that is `i` < span.count positions behind the first of a span.
  [[nodiscard]] std::uint32_t face_in(const Span& span, std::uint32_t i) const {
    return order_[wrap(span.first + i)];
  }
  [[nodiscard]] bool in_span(const Span& span, std::uint32_t face) const {
    return steps(span.first, at_[face]) < span.count;
  }
  /// Over the positions.
  [[nodiscard]] const CircleTree& circles() const { return tree_; }

  /// Calls use(face) for each face whose circle comes nearer than `radius` to a point.
  template <class Use>
  void visit_near(Vec2 centre, double radius, Use use);

 private:
  [[nodiscard]] std::uint32_t wrap(std::uint32_t position) const {
    return position >= n_ ? position - n_ : position;
  }
  [[nodiscard]] std::uint32_t steps(std::uint32_t from, std::uint32_t to) const {
    return to >= from ? to - from : to + n_ - from;
  }
  /// Of the two sides of a cut across the fold above `below` the one in below's subtree.
  [[nodiscard]] std::uint32_t inner(std::uint32_t below, std::uint32_t side) const {
    return in_subtree(below, side / 3) ? side : patch_.twin[side];
  }
  void hang_subtree(std::uint32_t below, std::uint32_t side);
  void hang_rest(std::uint32_t below, std::uint32_t side);
  void lay_behind(std::uint32_t q, std::uint32_t up, std::uint32_t hole, std::uint32_t moved);
  void shift_back(std::uint32_t first, std::uint32_t count, std::uint32_t by);
  void shift_forward(std::uint32_t first, std::uint32_t count, std::uint32_t by);
  void traverse(std::uint32_t start, std::uint32_t up, std::uint32_t position, const Rigid& placed);
  void renew(std::uint32_t first, std::uint32_t count);
  void settle(std::uint32_t face, const Rigid& placed);

  const Patch& patch_;
  std::uint32_t n_;
  Folds folds_;
  std::vector<std::uint32_t> order_;  ///< face at each position
  std::vector<std::uint32_t> at_;     ///< position of each face
  std::vector<std::uint32_t> size_;   ///< faces in each face's subtree
  std::vector<std::uint32_t> up_;     ///< side of each face to its parent; nothing at the root

  std::vector<Circle> own_circle_;  ///< of each face, in its own frame
  std::vector<Rigid> place_;
  std::vector<EdgedTriangle> own_edged_;  ///< of each face, in its own frame
  std::vector<EdgedTriangle> flat_;
  std::vector<Circle> circle_;
  CircleTree tree_;

  std::vector<std::uint32_t> removable_;
  std::vector<std::uint32_t> open_;  ///< space to work in
};

template <class Use>
void RootedNet::visit_near(Vec2 centre, double radius, Use use) {
  const Circle circle{centre, radius};
  open_.assign(1, 1);
  while (!open_.empty()) {
    const std::uint32_t node = open_.back();
    open_.pop_back();
    if (tree_[node].radius < 0.0 || apart(tree_[node], circle)) {
      continue;
    }
    if (node < tree_.first_leaf()) {
      open_.push_back(2 * node);
      open_.push_back(2 * node + 1);
      continue;
    }
    const std::uint32_t block = node - tree_.first_leaf();
    for (std::uint32_t met = tree_.meeting(block, circle); met != 0; met &= met - 1) {
      use(order_[block * CircleTree::block_size + static_cast<std::uint32_t>(std::countr_zero(met))]);
    }
  }
}

}  // namespace ridgecraft::unfold
