// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/anneal.hpp"

#include <optional>

#include "base/random.hpp"
#include "unfold/energy/exact_walk.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/energy/quick_walk.hpp"

namespace ridgecraft::unfold {
namespace {

/// With `meetings` only what has none counts; false where nothing such was found.
bool walk(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
          const Annealing& rules, FoldingMeetings* meetings, std::uint64_t seed, const Context& context) {
  Random random(seed);
  const Folds given = net.folds();
  NetEnergy energy(net.patch(), net.tree(), facts, room, weights);
  const std::optional<Folds> found = QuickWalk(net, energy, meetings, random.next()).run(rules, context);
  net.set_tree(found ? *found : given);
  if (!net.is_clean()) {
    net.set_tree(given);
  }
  if (meetings != nullptr) {
    meetings->count(net.tree());
    if (meetings->total() > 0) {
      net.set_tree(given);
      return false;
    }
  }
  if (!net.has_tabs() || rules.exact_trials == 0) {
    return true;
  }
  const Folds start = net.folds();
  energy.set_tree();
  net.set_tree(ExactWalk(net, energy, meetings, weights.bare, random.next()).run(rules, context));
  if (!net.is_clean()) {
    net.set_tree(start);
  }
  return true;
}

}  // namespace

CutFacts cut_facts(const ChangingNet& net, const TabOptions& options) {
  return net.has_tabs() ? cut_facts(net.tab_state(), options) : CutFacts();
}

CutFacts cut_facts(const TabState& tabs, const TabOptions& options) {
  return {tabs.candidates(), tabs.across(), tabs.seams(), options.clearance_mm};
}

void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context) {
  walk(net, facts, room, weights, rules, nullptr, seed, context);
}

bool anneal_folding_together(ChangingNet& net, const CutFacts& facts, const Room& room,
                             const Weights& weights, const Annealing& rules, std::uint64_t seed,
                             const Context& context) {
  FoldingMeetings meetings(net.patch());
  return walk(net, facts, room, weights, rules, &meetings, seed, context);
}

}  // namespace ridgecraft::unfold
