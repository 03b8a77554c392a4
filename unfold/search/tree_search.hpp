// SPDX-License-Identifier: GPL-3.0-or-later
// Single exchanges of a fold and a cut, drawn at random: what searches among the trees of one net try.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// The fold above the face `below` leaves the tree, the cut `side`, which crosses it, comes in.
struct Swap {
  std::uint32_t below = nothing;
  std::uint32_t side = nothing;
};

/// One of them; there must be one.
template <class T>
[[nodiscard]] const T& draw(const std::vector<T>& from, Random& random) {
  return from[random.below(static_cast<std::uint32_t>(from.size()))];
}

/// One of the folds on the way from one face to another goes, and one of the cuts across it comes in, so that
/// they hang together by another way. Nothing where there is none. `branch` is space to work in.
[[nodiscard]] std::optional<Swap> draw_swap_between(std::uint32_t f, std::uint32_t g, RootedNet& net,
                                                    Branch& branch, Random& random);

// The search for a spanning tree whose net has no overlap: tabu search over edge swaps of the unrooted tree.
//
// Sources: the swap of a subtree against its neighbours and the tabu list: L. Zawallich, "Unfolding polyhedra
// via tabu search", The Visual Computer 2024. Restriction to the tree path between two overlapping faces, and
// the wide stage of random samples: our own measurements (docs/design/unfolding.md).

/// The walk from tree to tree of one patch, which must be connected and outlive the search.
class TreeSearch {
 public:
  /// Overlap is penetration deeper than tolerance (mm).
  TreeSearch(const Patch& patch, double tolerance, std::uint64_t seed);
  TreeSearch(const TreeSearch&) = delete;
  TreeSearch& operator=(const TreeSearch&) = delete;
  ~TreeSearch() = default;

  /// Sets the tree (it must span the patch) and counts its overlaps. O(n log n + pairs).
  void set_tree(const Folds& folds);

  struct Budget {
    std::uint64_t iterations = 0;
    std::uint64_t idle = std::numeric_limits<std::uint64_t>::max();  ///< without a new best
  };
  /// Moves until nothing overlaps or the budget is spent; true when nothing overlaps. Idle iterations count
  /// on from one call to the next. Throws Error(interrupted), ends early at the context's deadline.
  bool run(const Budget& budget, const Context& context);

  [[nodiscard]] std::uint64_t overlaps() const { return pairs_.total(); }
  [[nodiscard]] const Folds& folds() const { return net_.folds(); }
  /// The tree with the fewest overlaps since set_tree, and their number.
  [[nodiscard]] const Folds& best_folds() const { return best_folds_; }
  [[nodiscard]] std::uint64_t best_overlaps() const { return best_total_; }
  [[nodiscard]] std::uint64_t iterations() const { return iteration_; }
  /// Whether far more is left than ever was when a net was found in the end.
  [[nodiscard]] bool hopeless() const;

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
  struct Chosen;

  [[nodiscard]] std::uint32_t pairs_across(std::uint32_t below);
  void find_path(std::uint32_t f, std::uint32_t g);
  void consider(const Move& move, std::uint32_t old_pairs, bool ties, Chosen& chosen);
  void reconsider(Chosen& chosen);
  void step();
  void local_stage(Chosen& chosen);
  void wide_stage(Chosen& chosen);
  [[nodiscard]] std::uint32_t draw_side(std::uint32_t below);

  const Patch& patch_;
  Random random_;
  RootedNet net_;
  OverlapPairs pairs_;

  Folds best_folds_;
  std::uint64_t best_total_ = 0;
  std::uint64_t iteration_ = 0;
  std::uint64_t best_at_ = 0;  ///< iteration of the best tree

  std::vector<std::uint64_t> tabu_until_;  ///< per side
  // Of one iteration.
  std::vector<Arc> path_;
  std::vector<Refused> refused_;
  std::vector<Refused> again_;
  FacePairs chosen_pairs_;                          ///< that the chosen move makes
  std::vector<std::uint32_t> path_pairs_;           ///< pairs_across of a face's fold, while ...
  std::vector<std::uint64_t> path_pairs_valid_at_;  ///< ... this is the iteration
};

}  // namespace ridgecraft::unfold
