// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tidy_piece.hpp"

#include <algorithm>
#include <vector>

#include "unfold/check.hpp"
#include "unfold/objective.hpp"
#include "unfold/search/layout.hpp"
#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// Trials for each face, and in all: later ones gain little.
constexpr std::uint64_t trials_per_face = 4;
constexpr std::uint64_t most_trials = 500;
/// Shapes that are better but not allowed, one after the other, after which no more are tried: asking is what
/// takes the time, and those that come later are hardly ever allowed.
constexpr unsigned most_refused = 32;
/// Above this a trial takes too long.
constexpr std::uint32_t most_faces = 1000;
/// Trials between two looks at the clock.
constexpr std::uint64_t trials_per_look = 16;
/// Below this there is no other tree worth looking at.
constexpr std::uint32_t fewest_faces = 4;
/// The number of parts of a piece costs the same whatever its tree is.
constexpr std::size_t one_part = 1;

/// Sides that could be folded instead of others, one of each two.
std::vector<std::uint32_t> cuts_of(const Patch& piece, const Folds& tree) {
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < tree.size(); ++side) {
    const std::uint32_t twin = piece.twin[side];
    if (twin != nothing && side < twin && tree[side] == 0 && piece.frozen[side] == 0) {
      cuts.push_back(side);
    }
  }
  return cuts;
}

}  // namespace

Folds tidy_piece(const Patch& piece, const Folds& tree, const std::function<bool(const Folds&)>& allowed,
                 const Weights& weights, double tolerance, std::uint64_t seed, const Context& context) {
  if (piece.size() < fewest_faces || piece.size() > most_faces) {
    return tree;
  }
  Random random(seed);
  TreeSearch net(piece, tolerance, random.next());
  net.set_tree(tree);
  const double before = cost_of_piece(piece, tree, one_part, weights);
  double cost = before;
  std::vector<std::uint32_t> cuts = cuts_of(piece, tree);
  const auto draw = [&](const std::vector<std::uint32_t>& from) {
    return from[random.below(static_cast<std::uint32_t>(from.size()))];
  };
  const std::uint64_t trials = std::min(most_trials, trials_per_face * piece.size());
  unsigned refused = 0;
  for (std::uint64_t trial = 0; trial < trials && !cuts.empty() && refused < most_refused; ++trial) {
    if (trial % trials_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        break;
      }
    }
    const std::uint32_t side = draw(cuts);
    const std::vector<std::uint32_t> path = net.removable_between(side / 3, piece.twin[side] / 3);
    if (path.empty()) {
      continue;
    }
    const std::uint32_t below = draw(path);
    if (!net.swap_is_clean(below, side)) {
      continue;
    }
    const std::uint32_t removed = net.side_above(below);
    const std::uint32_t moved = net.swap(below, side);
    const double changed = cost_of_piece(piece, net.folds(), one_part, weights);
    const bool better_shape = changed < cost;
    if (better_shape && allowed(net.folds())) {
      refused = 0;
      cost = changed;
      cuts = cuts_of(piece, net.folds());
    } else {
      refused += better_shape ? 1U : 0U;
      net.swap(moved, removed);
    }
  }
  // As everywhere: the search counts by small steps, only a fresh layout may call a net clean.
  const bool better = cost < before && find_overlaps(lay_out(piece, net.folds()), tolerance).empty();
  return better ? net.folds() : tree;
}

}  // namespace ridgecraft::unfold
