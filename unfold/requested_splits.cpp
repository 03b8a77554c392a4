// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/requested_splits.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/tab_split.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs_of_nets.hpp"

namespace ridgecraft::unfold {

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
