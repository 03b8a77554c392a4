// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/one_piece.hpp"

#include <array>

#include "base/random.hpp"
#include "unfold/search/fit_search.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// Compact trees first: they are most likely to fit.
constexpr std::array start_kinds{StartTree::short_cuts, StartTree::breadth_first, StartTree::flat_folds,
                                 StartTree::breadth_first, StartTree::depth_first};
constexpr std::uint64_t least_iterations = 600;
/// After so many hopeless starts the others aren't tried.
constexpr int hopeless_starts = 2;

}  // namespace

OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                             std::uint64_t seed, const Context& context) {
  OnePieceFound result;
  if (least_pieces(patch, room) > 1) {
    return result;
  }
  Random random(seed);
  NetSearch options;
  options.tolerance = search.tolerance;
  options.starts = 1;
  options.iterations = least_iterations + search.iterations_per_face * patch.size();
  options.idle = options.iterations;
  int hopeless = 0;  // starts that were
  for (int start = 0; start < search.starts && hopeless < hopeless_starts && !context.out_of_time();
       ++start) {
    context.check();
    options.start = start_kinds[static_cast<std::size_t>(start) % start_kinds.size()];
    NetFound found = find_net(patch, options, random.next(), context);
    result.cost += found.iterations * patch.size();
    hopeless += found.hopeless ? 1 : 0;
    const std::uint64_t fit_seed = random.next();
    if (found.overlaps > 0) {
      continue;
    }
    if (all_fit(patch, found.folds, room)) {
      result.tree = std::move(found.folds);
      return result;
    }
    result.cost += search.fit_trials * patch.size();
    Folds shrunk =
        shrink_to_fit(patch, found.folds, room, search.tolerance, search.fit_trials, fit_seed, context);
    if (all_fit(patch, shrunk, room)) {
      result.tree = std::move(shrunk);
      return result;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
