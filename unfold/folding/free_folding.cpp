// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/free_folding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "base/random.hpp"
#include "unfold/folding/fold_trial.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {
namespace {

/// Swaps that are drawn on one walk: most that arrive do so within a hundred.
constexpr std::size_t draws_per_walk = 1500;
/// Draws of all walks times the faces of the piece, since one takes longer the larger the piece is, and at
/// most: about 0.02 s.
constexpr std::size_t draws_times_faces = 200'000;
constexpr std::size_t most_draws = 6000;
/// Walks that arrive, and how many of the trees that they come to, those with the shortest cuts, are looked
/// at closely: that takes longer than the walk.
constexpr std::size_t most_arrivals = 16;
constexpr std::size_t looked_at = 4;
/// Larger pieces aren't tried: too many of their faces meet.
constexpr std::size_t most_faces = 1000;
/// Nor are such with more pairs that meet for each face: of those that walks freed none had half of it.
constexpr std::size_t most_meetings_per_face = 1;
/// A swap that costs d more is made with probability exp(-d / heat).
constexpr double heat = 0.35;
/// What a pair that meets on the way or overlaps is worth, in mm of cut.
constexpr double pair_mm = 60.0;
/// Draws between two looks at the clock.
constexpr std::size_t draws_per_look = 64;

/// Walks from tree to tree until there is neither meeting nor overlap; both are counted alike.
class FreeFolding {
 public:
  FreeFolding(const Patch& piece, const Folds& tree, double tolerance, std::uint64_t seed,
              const Context& context)
      : piece_(piece),
        tree_(tree),
        context_(context),
        random_(seed),
        branch_(piece),
        net_(piece),
        overlaps_(net_, tolerance),
        meetings_(piece) {}

  /// Whether so few faces of the given tree meet that a walk may arrive.
  [[nodiscard]] bool may_arrive() {
    net_.set_tree(tree_);
    meetings_.count(net_);
    return meetings_.total() <= most_meetings_per_face * piece_.size();
  }

  /// Goes from the given tree to one without any; false where the draws are spent before, or the time.
  bool walk(std::size_t draws) {
    net_.set_tree(tree_);
    overlaps_.find_all();
    meetings_.count(net_);
    longer_mm_ = 0.0;
    for (drawn_ = 0; drawn_ < draws && !done(); ++drawn_) {
      if (drawn_ % draws_per_look == 0) {
        context_.check();
        if (context_.out_of_time()) {
          break;
        }
      }
      step();
    }
    return done();
  }

  [[nodiscard]] const Folds& folds() const { return net_.folds(); }
  /// Of the last walk: swaps drawn, and by how much it made the cuts longer.
  [[nodiscard]] std::size_t drawn() const { return drawn_; }
  [[nodiscard]] double longer_mm() const { return longer_mm_; }

 private:
  [[nodiscard]] bool done() const { return meetings_.total() + overlaps_.total() == 0; }

  std::pair<std::uint32_t, std::uint32_t> draw_pair() {
    const std::uint32_t overlaps = static_cast<std::uint32_t>(overlaps_.total());
    const std::uint32_t meetings = static_cast<std::uint32_t>(meetings_.total());
    if (random_.below(overlaps + meetings) < meetings) {
      return draw(meetings_.pairs(), random_);
    }
    const std::uint32_t f = draw(overlaps_.bad_faces(), random_);
    return {f, draw(overlaps_.met_by(f), random_)};
  }

  void step() {
    const auto [f, g] = draw_pair();
    const std::optional<Swap> swap = draw_swap_between(f, g, net_, branch_, random_);
    if (!swap) {
      return;
    }
    const double longer = piece_.length[net_.side_above(swap->below)] - piece_.length[swap->side];
    const double may_cost = -heat * elementary::log(1.0 - random_.unit()) - longer / pair_mm;
    const auto met = static_cast<std::int64_t>(meetings_.total());
    // So many pairs may be left; overlaps are counted first, since that is quicker.
    const auto most = met + static_cast<std::int64_t>(std::floor(may_cost));
    const std::int64_t left = most - overlaps_.added(swap->below, swap->side, most + 1);
    if (left < 0) {
      return;
    }
    const std::size_t limit = static_cast<std::size_t>(left) + 1;
    if (meetings_.after(net_, *swap, limit) < limit) {
      overlaps_.swap(swap->below, swap->side);
      meetings_.keep(net_);
      longer_mm_ += longer;
    }
  }

  const Patch& piece_;
  const Folds& tree_;
  const Context& context_;
  Random random_;
  Branch branch_;
  RootedNet net_;
  OverlapPairs overlaps_;
  FoldingMeetings meetings_;
  std::size_t drawn_ = 0;
  double longer_mm_ = 0.0;
};

/// Trees that fold together, the one with the shortest cuts first.
std::vector<Folds> trees_that_fold(const ChangingNet& net, std::uint64_t seed, const Context& context) {
  const Patch& piece = net.patch();
  const Folds& given = net.folds();
  FreeFolding search(piece, given, net.tolerance(), seed, context);
  std::vector<std::pair<double, Folds>> found;
  std::size_t draws = search.may_arrive() ? std::min(most_draws, draws_times_faces / piece.size()) : 0;
  while (draws > 0 && found.size() < most_arrivals && !context.out_of_time()) {
    if (search.walk(std::min(draws, draws_per_walk))) {
      found.emplace_back(search.longer_mm(), search.folds());
    }
    draws -= std::min(draws, search.drawn());
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Folds> trees;
  for (auto& [longer, tree] : found) {
    if (std::find(trees.begin(), trees.end(), tree) == trees.end()) {
      trees.push_back(std::move(tree));
    }
  }
  return trees;
}

}  // namespace

bool folds_together(const Patch& piece, const Folds& tree, const Context& context) {
  const FoldMotion motion(flat_piece(piece, tree));
  return FoldTrial(motion, context).together_works();
}

bool fold_freely(ChangingNet& net, const CostOfNet& cost, double worth, std::uint64_t seed,
                 const Context& context) {
  const Patch& piece = net.patch();
  if (piece.size() > most_faces || folds_together(piece, net.folds(), context)) {
    return false;
  }
  const Folds given = net.folds();
  std::vector<Folds> trees = trees_that_fold(net, seed, context);
  trees.resize(std::min(trees.size(), looked_at));
  double least = cost(net).value_or(std::numeric_limits<double>::infinity()) + worth;
  const Folds* best = nullptr;
  for (const Folds& tree : trees) {
    net.set_tree(tree);
    const std::optional<double> costs = cost(net);
    if (costs && *costs <= least && net.is_clean() && folds_together(piece, tree, context)) {
      least = *costs;
      best = &tree;
    }
  }
  net.set_tree(best != nullptr ? *best : given);
  return best != nullptr;
}

}  // namespace ridgecraft::unfold
