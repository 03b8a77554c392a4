// SPDX-License-Identifier: GPL-3.0-or-later
// The search for a net: a walk from tree to tree of one patch until nothing overlaps.
//
// Each step draws a pair of faces that overlap, a fold on the way between them and a cut that could take its
// place, and makes the swap where it adds few pairs enough for the heat (N. Metropolis et al., 1953; focused
// on what is wrong: S. Seitz, M. Alava, P. Orponen, 2005). Swaps of a subtree for nets: L. Zawallich,
// "Unfolding polyhedra via tabu search", The Visual Computer 2024.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/forest_overlaps.hpp"

namespace ridgecraft::unfold {

/// What a walk looks for.
struct WalkRules {
  double tolerance = 0.0;       ///< of overlap, mm
  bool folds_together = false;  ///< faces that meet while all creases fold at once count as pairs, too
  double pairs_per_mm = 0.0;    ///< what a longer cut counts, in pairs
};

/// A walk from tree to tree of a connected patch, which must outlive it.
class NetWalk {
 public:
  NetWalk(const Patch& patch, const WalkRules& rules, std::uint64_t seed);

  /// Begins at this tree, which must span the patch. O(n log n + pairs).
  void set_tree(const Folds& folds);

  struct Fall {
    double first_heat = 0.0;  ///< in pairs: a swap that adds d is made with probability exp(-d / heat)
    double last_heat = 0.0;
    std::uint64_t trials = 0;  ///< swaps that are looked at
  };
  /// Walks while the heat falls, until nothing is wrong; true then. Throws Error(interrupted), ends early at
  /// the context's deadline.
  bool cool(const Fall& fall, const Context& context);

  [[nodiscard]] const Folds& folds() const { return forest_.folds(); }
  /// Pairs that overlap or meet now.
  [[nodiscard]] std::uint64_t pairs() const;
  /// The tree with the fewest pairs since set_tree, and their number.
  [[nodiscard]] const Folds& best() const { return best_; }
  [[nodiscard]] std::uint64_t least() const { return least_; }
  [[nodiscard]] std::uint64_t trials() const { return trials_; }
  /// By how much the cuts are longer than those of the tree where it began, mm.
  [[nodiscard]] double longer_mm() const { return longer_mm_; }

 private:
  void try_swap(double heat);
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> draw_pair();
  [[nodiscard]] std::uint32_t draw_cut(std::uint32_t fold);
  [[nodiscard]] std::uint32_t cut_at(std::uint32_t fold);
  [[nodiscard]] std::uint32_t cut_across(std::uint32_t fold);
  [[nodiscard]] bool may_close(std::uint32_t side) const;
  [[nodiscard]] bool keeps_folding(const Move& move, std::int64_t limit);

  const Patch& patch_;
  const WalkRules rules_;
  Random random_;
  Forest forest_;
  ForestOverlaps overlaps_;
  std::optional<FoldingMeetings> meetings_;
  Folds best_;
  std::uint64_t least_ = 0;
  std::uint64_t trials_ = 0;
  double longer_mm_ = 0.0;
  std::vector<std::uint32_t> moved_;  ///< space to work in
};

struct NetFound {
  Folds folds;                 ///< the best tree
  std::uint64_t overlaps = 0;  ///< of it; 0: a net, laid out afresh and checked
  std::uint64_t trials = 0;
};

/// Searches a connected patch for a tree without overlap deeper than `tolerance`, mm, beginning with a
/// spanning tree, until one is found or given up. Deterministic for one seed but for the deadline. Throws
/// Error(interrupted).
[[nodiscard]] NetFound find_net(const Patch& patch, const Folds& start, double tolerance, std::uint64_t seed,
                                const Context& context);

}  // namespace ridgecraft::unfold
