// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/all_tabs.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "unfold/give_tabs.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/tab_split.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

std::string counted(std::size_t number, const char* one, const char* more) {
  return std::to_string(number) + (number == 1 ? one : more);
}

}  // namespace

bool wants_all_tabs(const Options& options) {
  return options.tabs.wanted && options.tabs.split_pieces;
}

AllTabs give_all_tabs(const Asked& asked, const Plan& plan, const Patch& patch, const Folds& folds,
                      const Causes& causes, const Context& context) {
  if (context.out_of_time()) {
    return {folds, causes, 0, false};
  }
  // Nets as they will be returned: tabs go by the flat regions of the model.
  const NetsOf nets_of = [&](const Folds& tried) {
    Nets nets = nets_of_folds(asked.surface, asked.part, patch, tried, causes);
    close_flat_cuts(asked.surface, asked.panels, plan.possible_wishes, nets);
    give_tabs(asked.surface, asked.panels, asked.options, nets, context);
    return nets;
  };
  TabSplit split = split_for_tabs(asked.surface, asked.panels, patch, folds, plan.room, asked.options.tabs,
                                  nets_of, net_tolerance(patch.extent), context.seed, context);
  AllTabs result{std::move(split.folds), causes, 0, !context.out_of_time()};
  result.split_pieces = blame(patch, folds, result.folds, PieceReason::tabs, result.causes);
  return result;
}

void note_all_tabs(const Asked& asked, const AllTabs& split, Nets& nets) {
  const auto narrow = static_cast<std::size_t>(
      std::count_if(nets.joins.begin(), nets.joins.end(), [](const Join& join) { return join.too_narrow; }));
  const std::size_t usable = tabs_usable(asked.surface, nets, asked.options.tabs);
  std::vector<std::string> facts;
  facts.push_back((split.split_pieces == 0 ? std::string("no piece had to be")
                                           : counted(split.split_pieces, " piece was", " pieces were")) +
                  " split off for tabs");
  if (narrow > 0) {
    facts.push_back(counted(narrow, " edge is too short, or the faces behind it",
                            " edges are too short, or the faces behind them") +
                    " too narrow, for a tab that holds");
  }
  if (nets.joins.size() > usable + narrow) {
    facts.push_back(counted(nets.joins.size() - usable - narrow, " edge has", " edges have") +
                    (split.in_time ? " no room for a tab even so" : " no room for a tab yet"));
  }
  if (!split.in_time) {
    facts.emplace_back("the time given was up before all ways to split were tried");
  }
  std::string note = std::move(facts.front());
  for (std::size_t i = 1; i < facts.size(); ++i) {
    note += "; " + facts[i];
  }
  nets.notes.push_back(std::move(note));
}

}  // namespace ridgecraft::unfold
