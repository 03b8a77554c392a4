// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/better_trees.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "mesh/foundation/parallel.hpp"
#include "unfold/check.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/objective.hpp"
#include "unfold/pieces/tidy_piece.hpp"
#include "unfold/search/layout.hpp"
#include "unfold/search/sub_patch.hpp"
#include "unfold/tabs/tab_pieces.hpp"
#include "unfold/tabs/tab_search.hpp"
#include "unfold/tolerance.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a piece that folds freely may cost more, in edges to be glued, as the objective has it
/// (piece_rules.hpp).
constexpr double worth_of_free_folding = 2.0;
/// Trials for each face that win back tabs which free folding cost: each asks how the changed tree folds.
constexpr std::uint64_t trials_per_face = 4;

/// One piece and its tree.
class PieceTree {
 public:
  PieceTree(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch, const Folds& folds,
            const std::vector<std::uint32_t>& faces, const Options& options, const Room& room,
            const Context& context)
      : surface_(surface),
        panels_(panels),
        options_(options),
        room_(room),
        context_(context),
        piece_(sub_patch(patch, faces)),
        tree_(sub_folds(patch, folds, faces)),
        tolerance_(net_tolerance(piece_.extent)) {}

  Folds improved(Random& seed) {
    fits_ = all_fit(piece_, tree_, room_);
    if (options_.tabs.wanted) {
      tree_ = improve_tabs(surface_, panels_, piece_, tree_, room_, options_.tabs, tolerance_, seed.next(),
                           context_);
    }
    Folds free = fold_freely(
        piece_, tree_, [this](const Folds& other) { return is_worth(other); }, tolerance_, seed.next(),
        context_);
    if (tabs(free) < tabs(tree_)) {
      free = with_tabs_won_back(free, seed.next());
    }
    tree_ = std::move(free);
    return tidied(seed.next());
  }

 private:
  /// Whether another tree, which folds freely or nearly so, is good enough.
  [[nodiscard]] bool is_worth(const Folds& other) {
    cost_ = cost_ ? cost_ : cost(tree_);
    return fits(other) && cost(other) <= *cost_ + worth_of_free_folding;
  }

  [[nodiscard]] bool fits(const Folds& tree) const { return !fits_ || all_fit(piece_, tree, room_); }

  /// A tab is an edge that is easily glued.
  [[nodiscard]] double cost(const Folds& tree) const {
    constexpr std::size_t one_part = 1;  // whatever the tree is, the number of parts costs the same
    double sum = cost_of_piece(piece_, tree, one_part, options_.pieces.weights);
    return sum - tabs(tree);
  }

  /// Cuts that have a usable tab.
  [[nodiscard]] std::uint32_t tabs(const Folds& tree) const {
    const TabSearch no_search{tolerance_, 0, {}};
    return options_.tabs.wanted
               ? search_tabs(surface_, panels_, piece_, tree, options_.tabs, no_search, 0, context_).tabs
               : 0;
  }

  [[nodiscard]] Folds with_tabs_won_back(const Folds& free, std::uint64_t seed) const {
    TabSearch search;
    search.tolerance = tolerance_;
    search.trials = trials_per_face * piece_.size();
    search.allowed = [this](const Folds& tree) { return fits(tree) && folds_freely(piece_, tree, context_); };
    const TabSearchResult found =
        search_tabs(surface_, panels_, piece_, free, options_.tabs, search, seed, context_);
    const bool better =
        found.tabs > found.tabs_before && find_overlaps(lay_out(piece_, found.folds), tolerance_).empty();
    return better ? found.folds : free;
  }

  /// Shorter cuts and less waste, but no tab less, and what folds freely still does.
  [[nodiscard]] Folds tidied(std::uint64_t seed) const {
    const bool free = folds_freely(piece_, tree_, context_);
    const std::uint32_t tabs_now = tabs(tree_);
    const auto allowed = [&](const Folds& other) {
      return fits(other) && tabs(other) >= tabs_now && (!free || folds_freely(piece_, other, context_));
    };
    return tidy_piece(piece_, tree_, allowed, options_.pieces.weights, tolerance_, seed, context_);
  }

  const mesh::Surface& surface_;
  const mesh::Panels& panels_;
  const Options& options_;
  const Room& room_;
  const Context& context_;
  const Patch piece_;
  Folds tree_;
  double tolerance_;
  bool fits_ = false;           ///< the piece, before its tree was changed
  std::optional<double> cost_;  ///< of tree_, once it is asked for
};

}  // namespace

Folds better_trees(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                   const Folds& folds, const Options& options, const Room& room, const Context& context) {
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  std::vector<Folds> trees(pieces.size());
  do_in_parallel(
      pieces.size(), context,
      [&](std::size_t i, const Context& own) {
        Random seed(~context.seed ^ (0x9e3779b97f4a7c15ULL * (i + 1)));
        std::sort(pieces[i].begin(), pieces[i].end());
        trees[i] = PieceTree(surface, panels, patch, folds, pieces[i], options, room, own).improved(seed);
      },
      [&](std::size_t done) {
        context.report("unfold", 0.8 + 0.2 * static_cast<double>(done) / static_cast<double>(pieces.size()));
      });
  Folds result = folds;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    put_back(patch, pieces[i], trees[i], result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
