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
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a piece that folds freely may cost more, mm of seam (piece_rules.hpp).
constexpr double worth_of_free_folding_mm = 60.0;

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
    PieceCost cost(piece_, one_part, options_.pieces.weights);
    const double bare = options_.tabs.wanted ? options_.pieces.weights.bare : 0.0;
    const double limit = cost.of(net_.folds(), net_.hull()) - bare * net_.held_mm() + worth_of_free_folding_mm;
    const auto allowed = [&](ChangingNet& net) {
      const std::vector<Vec2> hull = net.hull();
      return (!fits_ || room_.holds(hull, panels_)) &&
             cost.of(net.folds(), hull) - bare * net.held_mm() <= limit;
    };
    fold_freely(net_, allowed, random_.next(), context_);
    return net_.folds();
  }

 private:
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
