// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tidy_piece.hpp"

#include <algorithm>
#include <vector>

#include "base/random.hpp"
#include "unfold/patch/objective.hpp"
#include "unfold/tabs/trees/tree_improvement.hpp"

namespace ridgecraft::unfold {
namespace {

/// Trials for each face, and in all: later ones gain little.
constexpr std::uint64_t tidying_per_face = 8;
constexpr std::uint64_t most_trials = 1000;
/// Share of the trials that begin at a cut without a tab.
constexpr double open_share = 0.3;
/// Above this a trial takes too long.
constexpr std::uint32_t most_tidied_faces = 1000;
/// Below this there is no other tree worth looking at.
constexpr std::uint32_t fewest_faces = 4;
/// A swap that takes the room of a tab from the outline, by angles alone, is hardly ever allowed.
constexpr double most_room_lost = 0.5;

class Tidying : public TreeGoal {
 public:
  Tidying(ChangingNet& net, const std::function<bool(ChangingNet&)>& allowed, const Weights& weights)
      : allowed_(allowed), cost_of_(net.patch(), one_part, weights), tabs_(net.tabs()) {
    cost_ = cost_of_.of(net.folds(), net.hull());
    find_cuts(net);
  }

  std::optional<Swap> draw(ChangingNet& net, Random& random) override {
    const bool at_open = !open_.empty() && random.unit() < open_share;
    const std::uint32_t cut = unfold::draw(at_open ? open_ : cuts_, random);
    const std::optional<Swap> swap = draw_swap_at(cut, net.patch(), net.tree(), random);
    if (!swap) {
      return std::nullopt;
    }
    const double lost = net.room_lost(*swap);
    most_tabs_won_ = std::max(0.0, -lost);
    return lost > most_room_lost ? std::nullopt : swap;
  }

  bool accepts(ChangingNet& net) override {
    const double cost = cost_of_.of(net.folds(), net.hull());
    if (!(cost < cost_ + most_tabs_won_) || net.tabs() < tabs_ ||
        !(cost < cost_ + static_cast<double>(net.tabs() - tabs_)) || !allowed_(net)) {
      return false;
    }
    cost_ = cost;
    tabs_ = net.tabs();
    find_cuts(net);
    return true;
  }

  [[nodiscard]] bool done() const override { return cuts_.empty(); }

 private:
  /// One side of each cut that could be a fold.
  void find_cuts(const ChangingNet& net) {
    const Patch& piece = net.patch();
    cuts_.clear();
    open_.clear();
    for (std::uint32_t side = 0; side < piece.twin.size(); ++side) {
      const std::uint32_t twin = piece.twin[side];
      if (twin != nothing && side < twin && net.folds()[side] == 0 && piece.frozen[side] == 0) {
        cuts_.push_back(side);
        if (net.has_tabs() && !net.tab_state().has_tab(side)) {
          open_.push_back(side);
        }
      }
    }
  }

  const std::function<bool(ChangingNet&)>& allowed_;
  PieceCost cost_of_;
  double cost_ = 0.0;
  std::uint32_t tabs_;
  double most_tabs_won_ = 0.0;  ///< by the swap that was drawn last
  std::vector<std::uint32_t> cuts_;
  std::vector<std::uint32_t> open_;  ///< those without a tab
};

}  // namespace

bool tidy_piece(ChangingNet& net, const std::function<bool(ChangingNet&)>& allowed, const Weights& weights,
                std::uint64_t seed, const Context& context) {
  const std::uint32_t faces = net.patch().size();
  if (faces < fewest_faces || faces > most_tidied_faces) {
    return false;
  }
  Tidying goal(net, allowed, weights);
  return improve_tree(net, goal, std::min(most_trials, tidying_per_face * faces), seed, context);
}

}  // namespace ridgecraft::unfold
