// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/joined_nets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "unfold/energy/piece_cost.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// Cuts at which two pieces are tried to be joined.
constexpr std::size_t shared_cuts_tried = 24;

/// The cuts between two trees: those inside flat regions first, then long ones.
std::vector<std::uint32_t> shared_cuts(const Patch& both, const Folds& apart) {
  const Layout layout = lay_out(both, apart);
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < both.twin.size(); ++side) {
    const std::uint32_t twin = both.twin[side];
    if (twin != nothing && side < twin && layout.piece[side / 3] != layout.piece[twin / 3]) {
      cuts.push_back(side);
    }
  }
  std::stable_sort(cuts.begin(), cuts.end(), [&](std::uint32_t s, std::uint32_t t) {
    return both.frozen[s] != both.frozen[t] ? both.frozen[s] > both.frozen[t]
                                            : both.length[s] > both.length[t];
  });
  cuts.resize(std::min(cuts.size(), shared_cuts_tried));
  return cuts;
}

}  // namespace

std::optional<Folds> join_as_they_are(const Patch& both, const Folds& apart, const Room& room,
                                      const Weights& weights, const NetsToJoin& rules, std::size_t& work) {
  double limit = rules.most_cost;
  std::optional<Folds> best;
  for (const std::uint32_t side : shared_cuts(both, apart)) {
    if (work < both.size()) {
      break;
    }
    work -= both.size();
    Folds trial = apart;
    set_fold(both, trial, side, true);
    if (!all_fit(both, trial, room)) {
      continue;
    }
    const double cost = cost_of_piece(both, trial, rules.parts, weights);
    if (cost < limit && find_overlaps(lay_out(both, trial), rules.tolerance).empty()) {
      limit = cost;
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
