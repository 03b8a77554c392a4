// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/free_folding.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// Swaps that are drawn on one walk: most that arrive do so within a hundred.
constexpr std::uint64_t draws_per_walk = 1500;
/// Draws of all walks times the faces of the piece, since one takes longer the larger the piece is, and at
/// most: about 0.02 s.
constexpr std::uint64_t draws_times_faces = 200'000;
constexpr std::uint64_t most_draws = 6000;
/// Walks that arrive, and how many of the trees that they come to, those with the shortest cuts, are looked
/// at closely: that takes longer than the walk.
constexpr std::size_t most_arrivals = 16;
constexpr std::size_t looked_at = 4;
/// Larger pieces aren't tried: too many of their faces meet.
constexpr std::size_t most_faces = 1000;
/// Nor are such with more pairs that meet for each face: of those that walks freed none had half of it.
constexpr std::size_t most_meetings_per_face = 1;
/// Of the walks, in pairs.
constexpr double heat = 0.35;
/// What a pair that meets on the way or overlaps is worth, in mm of cut.
constexpr double pair_mm = 60.0;

/// Whether so few faces of a tree meet that a walk may arrive.
bool may_arrive(const Patch& piece, const Folds& tree) {
  FoldingMeetings meetings(piece);
  meetings.count(tree);
  return meetings.total() <= most_meetings_per_face * piece.size();
}

/// Trees that fold together, the one with the shortest cuts first.
std::vector<Folds> trees_that_fold(const Patch& piece, const Folds& given, double tolerance,
                                   std::uint64_t seed, const Context& context) {
  std::vector<std::pair<double, Folds>> found;
  if (!may_arrive(piece, given)) {
    return {};
  }
  NetWalk walk(piece, {tolerance, true, 1.0 / pair_mm}, seed);
  const std::uint64_t draws = std::min<std::uint64_t>(most_draws, draws_times_faces / piece.size());
  while (walk.trials() < draws && found.size() < most_arrivals && !context.out_of_time()) {
    walk.set_tree(given);
    if (walk.cool({heat, heat, std::min(draws - walk.trials(), draws_per_walk)}, context)) {
      found.emplace_back(walk.longer_mm(), walk.folds());
    }
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

bool folds_together(const Patch& patch, const Folds& folds, const Context& context) {
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  return std::all_of(pieces.begin(), pieces.end(), [&](std::vector<std::uint32_t>& faces) {
    std::sort(faces.begin(), faces.end());
    const FoldMotion motion(flat_piece(sub_patch(patch, faces), sub_folds(patch, folds, faces)));
    return FoldTrial(motion, context).together_works();
  });
}

std::optional<Folds> fold_freely(const Patch& piece, const Folds& given, const FreeFoldingRules& rules,
                                 std::uint64_t seed, const Context& context) {
  if (piece.size() > most_faces || folds_together(piece, given, context)) {
    return std::nullopt;
  }
  std::vector<Folds> trees = trees_that_fold(piece, given, rules.tolerance, seed, context);
  trees.resize(std::min(trees.size(), looked_at));
  double least = rules.cost(given).value_or(std::numeric_limits<double>::infinity()) + rules.worth;
  std::optional<Folds> best;
  for (Folds& tree : trees) {
    const std::optional<double> costs = rules.cost(tree);
    if (costs && *costs <= least && find_overlaps(lay_out(piece, tree), rules.tolerance).empty() &&
        folds_together(piece, tree, context)) {
      least = *costs;
      best = std::move(tree);
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
