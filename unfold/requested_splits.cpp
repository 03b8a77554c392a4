// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/requested_splits.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/tab_split.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/free_folding.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs_of_nets.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

/// One piece of the forest and what becomes of it where it must fold with all creases together.
class Splitting {
 public:
  Splitting(const Patch& piece, Folds folds, const NetProblem& problem, std::uint64_t seed,
            const Context& context)
      : piece_(piece), folds_(std::move(folds)), problem_(problem), random_(seed), context_(context) {}

  /// Folds of pieces that fold together, but those that edges to be kept hold.
  Folds run() {
    std::vector<Faces> open = lay_out(piece_, folds_).faces;
    while (!open.empty()) {
      Faces faces = std::move(open.back());
      open.pop_back();
      std::sort(faces.begin(), faces.end());
      const Patch part = sub_patch(piece_, faces);
      Folds tree = folding_tree(part, sub_folds(piece_, folds_, faces));
      if (!folds_together(part, tree, context_)) {
        const std::uint32_t cut = cut_of(part, tree);
        if (cut != no_index) {
          set_fold(part, tree, cut, false);
          for (const Faces& half : lay_out(part, tree).faces) {
            Faces& next = open.emplace_back();
            std::transform(half.begin(), half.end(), std::back_inserter(next),
                           [&](std::uint32_t f) { return faces[f]; });
          }
        }
      }
      put_back(piece_, faces, tree, folds_);
    }
    return std::move(folds_);
  }

 private:
  /// A tree that folds together, or the given one.
  Folds folding_tree(const Patch& part, const Folds& tree) {
    const std::size_t panels = panel_count(part);
    const auto fits = [&](const Folds& folds) {
      const Layout layout = lay_out(part, folds);
      return problem_.room.holds(hull_of(layout, layout.faces.front()), panels);
    };
    const bool fits_now = fits(tree);
    const auto cut_mm = [&](const Folds& changed) -> std::optional<double> {
      if (fits_now && !fits(changed)) {
        return std::nullopt;
      }
      double cut_mm = 0.0;
      for (std::uint32_t side = 0; side < changed.size(); ++side) {
        cut_mm += part.twin[side] != no_index && changed[side] == 0 ? 0.5 * part.length[side] : 0.0;
      }
      return cut_mm;
    };
    const FreeFoldingRules rules{problem_.tolerance(), cut_mm, std::numeric_limits<double>::infinity()};
    return fold_freely(part, tree, rules, random_.next(), context_).value_or(tree);
  }

  /// The fold that parts the most pairs of faces that meet on the way; nothing where none parts any.
  [[nodiscard]] std::uint32_t cut_of(const Patch& part, const Folds& tree) const {
    FoldingMeetings meetings(part);
    meetings.count(tree);
    Forest forest(part);
    forest.set_folds(tree);
    std::vector<std::uint32_t> parts(tree.size(), 0);  // per side of a fold: pairs that it would part
    std::uint32_t best = no_index;
    for (const auto& [f, g] : meetings.pairs()) {
      for (const std::uint32_t fold : forest.folds_between(f, g)) {
        const std::uint32_t hits = ++parts[fold];
        best = best == no_index || hits > parts[best] ? fold : best;
      }
    }
    return best;
  }

  const Patch& piece_;
  Folds folds_;
  const NetProblem& problem_;
  Random random_;
  const Context& context_;
};

}  // namespace

Folds split_to_fold_together(const NetProblem& problem, const Folds& folds, const Context& context) {
  const Patch& patch = problem.patch;
  std::vector<Faces> pieces = lay_out(patch, folds).faces;
  std::vector<Folds> splits(pieces.size());
  do_in_parallel(pieces.size(), context, [&](std::size_t i, const Context& own) {
    std::sort(pieces[i].begin(), pieces[i].end());
    const Patch piece = sub_patch(patch, pieces[i]);
    const std::uint64_t seed = Random::stream(context.seed, i).next();
    splits[i] = Splitting(piece, sub_folds(patch, folds, pieces[i]), problem, seed, own).run();
  });
  Folds result = folds;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    put_back(patch, pieces[i], splits[i], result);
  }
  return result;
}

void note_linear_folding(std::size_t split_pieces, Nets& nets) {
  nets.notes.push_back(
      Message(split_pieces == 0 ? "none_split_to_fold" : "split_to_fold", {{"n", split_pieces}}));
  const auto others = std::count_if(nets.pieces.begin(), nets.pieces.end(), [](const Piece& piece) {
    return piece.folding.way != FoldWay::together;
  });
  if (others > 0) {
    nets.notes.push_back(Message("dont_fold_together", {{"n", others}}));
  }
}

Folds give_all_tabs(const UnfoldProblem& problem, const NetProblem& nets, const EdgeConstraints& constraints,
                    const Folds& folds, const Context& context) {
  if (context.out_of_time()) {
    return folds;
  }
  // Nets as they will be returned: tabs go by the flat regions of the model.
  const NetsOf nets_of = [&](const Folds& tried) {
    Nets made = nets_of_folds(problem.surface, problem.part, nets.patch, tried);
    close_flat_cuts(problem.surface, problem.panels, constraints, made);
    give_tabs({problem.surface, problem.panels, problem.options}, made, context);
    return made;
  };
  const NetProblem tabbed{problem.surface, problem.panels, nets.patch, nets.part, problem.options, nets.room};
  return split_for_tabs(tabbed, folds, nets_of, context);
}

void note_all_tabs(const UnfoldProblem& problem, const AllTabs& split, Nets& nets) {
  const auto narrow = static_cast<std::size_t>(
      std::count_if(nets.joins.begin(), nets.joins.end(), [](const Join& join) { return join.too_narrow; }));
  const std::size_t usable = tabs_usable(problem.surface, nets, problem.options.tabs);
  std::vector<Message> facts;
  facts.push_back(Message(split.split_pieces == 0 ? "none_split_for_tabs" : "split_for_tabs",
                          {{"n", split.split_pieces}}));
  if (narrow > 0) {
    facts.push_back(Message("too_narrow_for_tabs", {{"n", narrow}}));
  }
  if (nets.joins.size() > usable + narrow) {
    facts.push_back(Message(split.in_time ? "still_no_room" : "no_room_yet",
                            {{"n", nets.joins.size() - usable - narrow}}));
  }
  if (!split.in_time) {
    facts.emplace_back("splits_untried");
  }
  nets.notes.push_back(Message("all_of", {{"facts", std::move(facts)}}));
}

}  // namespace ridgecraft::unfold
