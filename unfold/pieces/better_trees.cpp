// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/better_trees.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/objective.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/tidy_piece.hpp"
#include "unfold/tabs/trees/tab_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a piece that folds freely may cost more, in edges to be glued, as the objective has it
/// (piece_rules.hpp).
constexpr double worth_of_free_folding = 2.0;
/// Trials for each face that win back tabs which free folding cost: some ask how the changed tree folds.
constexpr std::uint64_t regaining_trials_per_face = 4;
/// Faces beyond these bring the search for tabs no more trials.
constexpr double most_faces = 2000.0;

/// One piece and its tree.
class PieceTree {
 public:
  PieceTree(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
            const Folds& folds, const std::vector<std::uint32_t>& faces, const Options& options,
            const Room& room, Random random, const Context& context)
      : options_(options),
        room_(room),
        context_(context),
        random_(random),
        piece_(sub_patch(patch, faces)),
        panels_(panel_count(piece_)),
        net_(surface, panels, piece_, sub_folds(patch, folds, faces), options.tabs,
             net_tolerance(piece_.extent)) {
    // The sequence is used from its second number on: nets that people have already come from there.
    static_cast<void>(random_.next());
    fits_ = room_.holds(net_.hull(), panels_);
  }

  Folds improved() {
    if (options_.tabs.wanted) {
      TabSearch search;
      search.trials = static_cast<std::uint64_t>(options_.tabs.trials_per_face *
                                                 std::min(most_faces, static_cast<double>(piece_.size())));
      search.allowed = [this](const Folds&) { return fits(); };
      improve_tabs(net_, search, random_.next(), context_);
    }
    const std::uint32_t tabs = net_.tabs();
    let_fold_freely();
    if (net_.tabs() < tabs) {
      win_tabs_back();
    }
    tidy();
    return net_.folds();
  }

 private:
  /// A piece that fits the room still has to.
  [[nodiscard]] bool fits() const { return !fits_ || room_.holds(net_.hull(), panels_); }

  void let_fold_freely() {
    PieceCost cost(piece_, one_part, options_.pieces.weights);
    // A tab is an edge that is easily glued.
    const double limit = cost.of(net_.folds(), net_.hull()) - net_.tabs() + worth_of_free_folding;
    const std::uint32_t most_tabs = net_.tabs() + most_tabs_won;
    const auto allowed = [&](ChangingNet& net) {
      const std::vector<Vec2> hull = net.hull();
      const double shape = cost.of(net.folds(), hull);
      return shape - most_tabs <= limit && (!fits_ || room_.holds(hull, panels_)) &&
             shape - net.tabs() <= limit;
    };
    fold_freely(net_, allowed, random_.next(), context_);
  }

  /// Tabs that free folding cost.
  void win_tabs_back() {
    TabSearch search;
    search.trials = regaining_trials_per_face * piece_.size();
    search.allowed = [this](const Folds&) { return fits(); };
    search.best_allowed = [this](const Folds& tree) { return folds_freely(piece_, tree, context_); };
    improve_tabs(net_, search, random_.next(), context_);
  }

  /// What folds freely still does then.
  void tidy() {
    const bool free = folds_freely(piece_, net_.folds(), context_);
    const auto allowed = [&](ChangingNet& net) {
      return fits() && (!free || folds_freely(piece_, net.folds(), context_));
    };
    tidy_piece(net_, allowed, options_.pieces.weights, random_.next(), context_);
  }

  /// No swap wins more tabs.
  static constexpr std::uint32_t most_tabs_won = 3;

  const Options& options_;
  const Room& room_;
  const Context& context_;
  Random random_;
  const Patch piece_;
  std::size_t panels_;
  ChangingNet net_;
  bool fits_ = false;  ///< the piece, before its tree was changed
};

}  // namespace

Folds better_trees(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                   const Folds& folds, const Options& options, const Room& room, const Context& context) {
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  std::vector<Folds> trees(pieces.size());
  do_in_parallel(
      pieces.size(), context,
      [&](std::size_t i, const Context& own) {
        // Parts were unfolded with the streams of the seed itself.
        const Random random = Random::stream(~context.seed, i);
        std::sort(pieces[i].begin(), pieces[i].end());
        if (own.out_of_grace()) {
          trees[i] = sub_folds(patch, folds, pieces[i]);
          return;
        }
        trees[i] = PieceTree(surface, panels, patch, folds, pieces[i], options, room, random, own).improved();
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
