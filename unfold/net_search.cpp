// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net_search.hpp"

#include <algorithm>
#include <array>

#include "unfold/check.hpp"
#include "unfold/layout.hpp"
#include "unfold/tree_search.hpp"

namespace ridgecraft::unfold {
namespace {

constexpr std::array kinds{StartTree::short_cuts, StartTree::depth_first, StartTree::breadth_first,
                           StartTree::flat_folds};

StartTree kind_of_start(StartTree first, int start) {
  const auto at = static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), first) - kinds.begin());
  return kinds[(at + static_cast<std::size_t>(start)) % kinds.size()];
}

}  // namespace

std::uint64_t idle_iterations(std::uint32_t faces) {
  // Solved nets need about half an iteration per face, spiky solids seven; hopeless small parts are common
  // and must not hold up the rest.
  const std::uint64_t n = faces;
  return std::max(std::clamp<std::uint64_t>(10 * n, 500, 4000), 4 * n);
}

std::uint64_t iteration_budget(std::uint32_t faces) {
  // An iteration takes longer the larger the patch is: very large ones get their share of about a minute.
  constexpr std::uint64_t faces_times_iterations = 400'000'000;
  const std::uint64_t affordable = faces_times_iterations / std::max(faces, 1U);
  return std::min(4 * idle_iterations(faces), affordable);
}

NetFound find_net(const Patch& patch, const NetSearch& options, std::uint64_t seed, const Context& context) {
  Random random(seed);
  TreeSearch search(patch, options.tolerance, random.next());
  const std::uint64_t idle = options.idle > 0 ? options.idle : idle_iterations(patch.size());
  NetFound found;
  found.overlaps = std::numeric_limits<std::uint64_t>::max();
  while (found.overlaps > 0 && found.starts < options.starts) {
    if (found.starts > 0 && (search.iterations() >= options.iterations || context.out_of_time())) {
      break;
    }
    search.set_tree(start_tree(patch, kind_of_start(options.start, found.starts), random));
    ++found.starts;
    search.run({options.iterations - std::min(options.iterations, search.iterations()), idle}, context);
    std::uint64_t overlaps = search.best_overlaps();
    if (overlaps == 0) {
      // The search counts by small steps; only a fresh layout and another routine may call a net clean.
      overlaps = find_overlaps(lay_out(patch, search.best_folds()), options.tolerance).size();
    }
    if (overlaps < found.overlaps) {
      found.overlaps = overlaps;
      found.folds = search.best_folds();
    }
  }
  found.iterations = search.iterations();
  return found;
}

}  // namespace ridgecraft::unfold
