// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/start_nets.hpp"

#include <algorithm>
#include <utility>

#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/overlap_split.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {
namespace {

bool has_panels(const Patch& patch) {
  return std::any_of(patch.frozen.begin(), patch.frozen.end(), [](std::uint8_t f) { return f != 0; });
}

/// The best tree that the search for one net comes to.
Folds searched_tree(const Patch& patch, const StartRules& rules, Random& random, const Context& context) {
  const auto search = [&](const Patch& of) {
    const Folds start = start_tree(of, random);
    return find_net(of, start, rules.tolerance, random.next(), context);
  };
  NetFound net = search(patch);
  if (net.overlaps > 0 && rules.panel_cuts == PanelCuts::before_pieces && has_panels(patch)) {
    Patch loose = patch;
    std::fill(loose.frozen.begin(), loose.frozen.end(), std::uint8_t{0});
    if (NetFound other = search(loose); other.overlaps == 0) {
      net = std::move(other);
    }
  }
  return std::move(net.folds);
}

}  // namespace

Folds start_nets(const Patch& patch, const Room& room, const StartRules& rules, std::uint64_t seed,
                 const Context& context) {
  Random random(seed);
  Folds folds = rules.one_net ? searched_tree(patch, rules, random, context) : start_tree(patch, random);
  if (!all_fit(patch, folds, room)) {
    folds = split_to_fit(patch, folds, room, random, context);
  }
  // Whatever the steps before believed, a fresh layout decides.
  while (!find_overlaps(lay_out(patch, folds), rules.tolerance).empty()) {
    folds = split_overlaps(patch, folds, rules.tolerance);
  }
  return folds;
}

}  // namespace ridgecraft::unfold
