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

NetFound first_net(const Patch& patch, const StartRules& rules, Random& random, const Context& context) {
  const std::uint32_t n = patch.size();
  const Folds start = start_tree(patch, random);
  return find_net(patch, start, {rules.tolerance, rules.patient ? patient_trials(n) : quick_trials(n)},
                  random.next(), context);
}

bool has_panels(const Patch& patch) {
  return std::any_of(patch.frozen.begin(), patch.frozen.end(), [](std::uint8_t f) { return f != 0; });
}

}  // namespace

Folds start_nets(const Patch& patch, const Room& room, const StartRules& rules, std::uint64_t seed,
                 const Context& context) {
  Random random(seed);
  NetFound net = first_net(patch, rules, random, context);
  if (net.overlaps > 0 && rules.panel_cuts == PanelCuts::before_pieces && has_panels(patch)) {
    Patch loose = patch;
    std::fill(loose.frozen.begin(), loose.frozen.end(), std::uint8_t{0});
    if (NetFound other = first_net(loose, rules, random, context); other.overlaps == 0) {
      net = std::move(other);
    }
  }
  Folds folds = std::move(net.folds);
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
