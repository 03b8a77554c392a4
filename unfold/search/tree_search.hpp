// SPDX-License-Identifier: GPL-3.0-or-later
// The search for a spanning tree whose net has no overlap: tabu search over edge swaps of the unrooted tree.
//
// Sources: the swap of a subtree against its neighbours and the tabu list: L. Zawallich, "Unfolding polyhedra
// via tabu search", The Visual Computer 2024. Restriction to the tree path between two overlapping faces, and
// the wide stage of random samples: our own measurements (docs/unfolding.md).
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/start_tree.hpp"
#include "unfold/search/circle_tree.hpp"
#include "unfold/search/edged_triangle.hpp"

namespace ridgecraft::unfold {

/// The state of one tree over a patch and the moves on it. The patch must be connected and outlive the
/// search.
///
/// The tree is kept as one flag per side and, for the traversal from a root, a cyclic preorder: the subtree
/// of v is the cyclic interval of size_[v] positions from at_[v], its complement is one cyclic interval too,
/// so either side of a removed fold can be the one that moves, and a circle tree over the positions answers
/// what it would meet.
class TreeSearch {
 public:
  /// Overlap is penetration deeper than tolerance (mm).
  TreeSearch(const Patch& patch, double tolerance, std::uint64_t seed);

  /// Sets the tree (it must span the patch) and counts its overlaps. O(n log n + pairs).
  void set_tree(const Folds& folds);

  struct Budget {
    std::uint64_t iterations = 0;
    std::uint64_t idle = std::numeric_limits<std::uint64_t>::max();  ///< without a new best
  };
  /// Moves until nothing overlaps or the budget is spent; true when nothing overlaps. Idle iterations count
  /// on from one call to the next. Throws Error(interrupted), ends early at the context's deadline.
  bool run(const Budget& budget, const Context& context);

  [[nodiscard]] std::uint64_t overlaps() const { return total_; }
  [[nodiscard]] const Folds& folds() const { return folds_; }
  /// The tree with the fewest overlaps since set_tree, and their number.
  [[nodiscard]] const Folds& best_folds() const { return best_folds_; }
  [[nodiscard]] std::uint64_t best_overlaps() const { return best_total_; }
  [[nodiscard]] std::uint64_t iterations() const { return iteration_; }
  /// Whether far more is left than ever was when a net was found in the end.
  [[nodiscard]] bool hopeless() const { return hopeless_after(iteration_); }
  /// The same if so many iterations had been made and hadn't found a better tree.
  [[nodiscard]] bool hopeless_after(std::uint64_t iterations) const;

  // What a search for something else than overlap needs (tab_search.hpp): tree_swaps.cpp.

  /// A face's corners in the plane.
  [[nodiscard]] const Triangle& flat(std::uint32_t face) const { return flat_[face].corner; }
  /// Folds that may be removed on the tree path between two faces, each named by the face below it.
  [[nodiscard]] const std::vector<std::uint32_t>& removable_between(std::uint32_t f, std::uint32_t g);
  /// The side of `below` to its parent.
  [[nodiscard]] std::uint32_t side_above(std::uint32_t below) const { return up_[below]; }
  /// Would removing the fold above `below` and folding `side`, which crosses it, make no new overlap?
  [[nodiscard]] bool swap_is_clean(std::uint32_t below, std::uint32_t side);
  /// How many overlaps the swap adds (negative: takes away); `limit` or more where it is that many at least.
  [[nodiscard]] std::int64_t overlaps_added(std::uint32_t below, std::uint32_t side, std::int64_t limit);
  /// Makes the swap and returns the face below the new fold, whose subtree is the side that moved.
  std::uint32_t swap(std::uint32_t below, std::uint32_t side);
  /// Calls use(face) for each face whose circle comes nearer than `radius` to a point.
  template <class Use>
  void visit_near(Vec2 centre, double radius, Use use);
  /// Calls use(f, g) for the pairs of a face on either side of the fold above `below` whose circles come
  /// nearer than `reach`.
  template <class Use>
  void visit_near_across(std::uint32_t below, double reach, Use use);

 private:
  /// Remove the fold above `below`, fold `side` instead: it belongs to a face of below's subtree, its twin
  /// does not.
  struct Move {
    std::uint32_t below = nothing;
    std::uint32_t side = nothing;
  };
  /// A move that added too many overlaps to be counted to the end.
  struct Refused {
    Move move;
    std::uint32_t old_pairs = 0;
  };
  struct Arc {
    std::uint32_t smaller = 0;  ///< faces on the smaller side
    std::uint32_t below = 0;
  };
  /// A cyclic interval of positions.
  struct Span {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  /// Two nodes of the circle tree that come near each other when the first is carried to `centre`.
  struct Meeting {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Vec2 centre;
  };
  struct Chosen;
  class Descent;

  [[nodiscard]] std::uint32_t wrap(std::uint32_t position) const {
    return position >= n_ ? position - n_ : position;
  }
  [[nodiscard]] std::uint32_t steps(std::uint32_t from, std::uint32_t to) const {
    return to >= from ? to - from : to + n_ - from;
  }
  [[nodiscard]] bool in_subtree(std::uint32_t v, std::uint32_t x) const {
    return steps(at_[v], at_[x]) < size_[v];
  }
  [[nodiscard]] bool in_span(const Span& span, std::uint32_t x) const {
    return steps(span.first, at_[x]) < span.count;
  }
  [[nodiscard]] bool moves_subtree(std::uint32_t v) const { return 2 * size_[v] <= n_; }
  [[nodiscard]] Span moved_span(std::uint32_t v) const {
    return moves_subtree(v) ? Span{at_[v], size_[v]} : Span{wrap(at_[v] + size_[v]), n_ - size_[v]};
  }
  [[nodiscard]] Rigid motion(const Move& move) const;

  void find_all_pairs();
  void add_pair(std::uint32_t f, std::uint32_t g);
  void remove_pair_of(std::uint32_t f, std::uint32_t g);
  void mark_clean(std::uint32_t f);

  void find_path(std::uint32_t f, std::uint32_t g);
  [[nodiscard]] std::uint32_t pairs_across(std::uint32_t below);
  template <class Use>
  void visit_pairs_across(const Span& moved, Use use);
  std::uint32_t new_pairs(const Move& move, std::uint32_t limit);
  void consider(const Move& move, std::uint32_t old_pairs, bool ties, Chosen& chosen);
  void reconsider(Chosen& chosen);
  void step();
  void local_stage(Chosen& chosen);
  void wide_stage(Chosen& chosen);
  [[nodiscard]] std::uint32_t draw_side(std::uint32_t below);

  void apply(const Move& move);
  void drop_pairs_across(std::uint32_t below);
  void hang_subtree(const Move& move);
  void hang_rest(const Move& move);
  void shift_back(std::uint32_t first, std::uint32_t count, std::uint32_t by);
  void shift_forward(std::uint32_t first, std::uint32_t count, std::uint32_t by);
  void traverse(std::uint32_t start, std::uint32_t up, std::uint32_t position, const Rigid& placed);
  void renew(std::uint32_t first, std::uint32_t count);
  void settle(std::uint32_t face, const Rigid& placed);

  const Patch& patch_;
  std::uint32_t n_;
  double tolerance_;
  Random random_;

  Folds folds_;
  Folds best_folds_;
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

  std::vector<std::vector<std::uint32_t>> meets_;  ///< faces that each face overlaps now
  std::vector<std::uint32_t> bad_;                 ///< faces that overlap any
  std::vector<std::uint32_t> bad_at_;              ///< place of each face in bad_
  std::uint64_t total_ = 0;
  std::uint64_t best_total_ = 0;
  std::uint64_t iteration_ = 0;
  std::uint64_t best_at_ = 0;  ///< iteration of the best tree

  std::vector<std::uint64_t> tabu_until_;  ///< per side
  std::vector<Refused> refused_;
  std::vector<Refused> again_;
  std::vector<Arc> path_;
  std::vector<std::uint32_t> path_pairs_;           ///< pairs_across of a face's fold, while ...
  std::vector<std::uint64_t> path_pairs_valid_at_;  ///< ... this is the iteration

  std::vector<std::uint32_t> removable_;
  std::vector<Meeting> meetings_;
  std::vector<std::uint32_t> sides_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found_;  ///< pairs of the move that was evaluated last
  std::vector<std::pair<std::uint32_t, std::uint32_t>> chosen_pairs_;  ///< pairs of the chosen move
  std::vector<std::pair<std::uint32_t, std::uint32_t>> dropped_;       ///< pairs that the move resolves
  std::vector<EdgedTriangle> moved_;     ///< per face: its corners under the evaluated move
  std::vector<std::uint64_t> moved_in_;  ///< evaluation that moved_ is of
  std::uint64_t evaluation_ = 0;
};

template <class Use>
void TreeSearch::visit_near(Vec2 centre, double radius, Use use) {
  const Circle circle{centre, radius};
  sides_.assign(1, 1);
  while (!sides_.empty()) {
    const std::uint32_t node = sides_.back();
    sides_.pop_back();
    if (tree_[node].radius < 0.0 || apart(tree_[node], circle)) {
      continue;
    }
    if (node < tree_.first_leaf()) {
      sides_.push_back(2 * node);
      sides_.push_back(2 * node + 1);
      continue;
    }
    const std::uint32_t block = node - tree_.first_leaf();
    for (std::uint32_t met = tree_.meeting(block, circle); met != 0; met &= met - 1) {
      use(order_[block * CircleTree::block_size + static_cast<std::uint32_t>(std::countr_zero(met))]);
    }
  }
}

template <class Use>
void TreeSearch::visit_near_across(std::uint32_t below, double reach, Use use) {
  constexpr std::uint32_t size = CircleTree::block_size;
  const Span moved = moved_span(below);
  const std::uint32_t leaf = tree_.first_leaf();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;  // blocks of the side that moves, nodes
  const auto begin = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t block = first / size; block * size < last; ++block) {
      open.emplace_back(block, 1);
    }
  };
  begin(moved.first, std::min(moved.first + moved.count, n_));
  begin(0, moved.first + moved.count > n_ ? moved.first + moved.count - n_ : 0);
  const auto inside = [&](std::uint32_t position) { return steps(moved.first, position) < moved.count; };
  const auto test_blocks = [&](std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t i = a * size; i < std::min(a * size + size, n_); ++i) {
      if (!inside(i)) {
        continue;
      }
      Circle circle = tree_.circle(i);
      circle.radius += reach;
      for (std::uint32_t met = tree_.meeting(b, circle); met != 0; met &= met - 1) {
        const std::uint32_t j = b * size + static_cast<std::uint32_t>(std::countr_zero(met));
        if (!inside(j)) {
          use(order_[i], order_[j]);
        }
      }
    }
  };
  while (!open.empty()) {
    const auto [block, node] = open.back();
    open.pop_back();
    const Circle& here = tree_[leaf + block];
    if (tree_[node].radius < 0.0 || apart({here.centre, here.radius + reach}, tree_[node])) {
      continue;
    }
    if (node >= leaf) {
      test_blocks(block, node - leaf);
    } else {
      open.emplace_back(block, 2 * node);
      open.emplace_back(block, 2 * node + 1);
    }
  }
}

}  // namespace ridgecraft::unfold
