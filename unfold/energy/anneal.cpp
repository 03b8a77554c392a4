// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/anneal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {
namespace {

/// Paths between two looks at the clock.
constexpr std::uint64_t paths_per_look = 64;
/// Folds that are tried on one path: finding it takes as long as rating a few.
constexpr int folds_per_path = 8;
/// Share of the trials that begin at a cut without room for a tab, or without a mirror image, if a few draws
/// find one.
constexpr double chosen_share = 0.4;
constexpr int draws = 6;
/// Cost of an overlap, mm, at first and at last.
constexpr double first_price = 20.0;
constexpr double last_price = 200.0;
/// A swap whose cuts cost more than may be spent is looked at no closer, but for so much, mm, and so many times
/// the heat: its shape may make up for it.
constexpr double least_slack = 4.0;
constexpr double slack_of_heat = 2.0;
/// The same where tabs are looked at exactly: angles may be wrong by as much, mm.
constexpr double exact_slack = 15.0;
/// Less than this is rounding, mm.
constexpr double better_by = 1e-6;

/// One side of each cut that could be a fold.
std::vector<std::uint32_t> cuts_of(const Patch& patch, const Folds& folds) {
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && side < twin && folds[side] == 0 && patch.frozen[side] == 0) {
      cuts.push_back(side);
    }
  }
  return cuts;
}

double between(double first, double last, std::uint64_t trial, std::uint64_t trials) {
  return first * std::pow(last / first, static_cast<double>(trial) / static_cast<double>(trials));
}

/// The quick half: tabs are told by angles, overlaps have a price.
class QuickWalk {
 public:
  QuickWalk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed)
      : patch_(net.patch()),
        net_(net.tree()),
        pairs_(net_, net.tolerance()),
        energy_(energy),
        cuts_(cuts_of(patch_, net_.folds())),
        random_(seed) {
    pairs_.find_all();
    if (pairs_.total() == 0) {
      least_ = energy_.total();
    }
  }

  std::optional<Folds> run(const Annealing& rules, const Context& context) {
    std::uint64_t paths = 0;
    for (std::uint64_t trial = 0; trial < rules.quick_trials && !cuts_.empty();) {
      if (paths++ % paths_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      heat_ = between(rules.first_heat, rules.middle_heat, trial, rules.quick_trials);
      price_ = between(first_price, last_price, trial, rules.quick_trials);
      trial += try_path(draw_cut());
    }
    return std::move(best_);
  }

 private:
  std::uint32_t draw_cut() {
    const auto count = static_cast<std::uint32_t>(cuts_.size());
    std::uint32_t at = random_.below(count);
    if (random_.unit() < chosen_share) {
      const CutCosts& costs = energy_.cut_costs();
      for (int draw = 0; draw < draws && !costs.lacks_tab(cuts_[at]) && !costs.is_uneven(cuts_[at]); ++draw) {
        at = random_.below(count);
      }
    }
    return at;
  }

  /// Tries to make a cut a fold, until a swap is accepted; the number of trials.
  std::uint64_t try_path(std::uint32_t at) {
    const std::uint32_t cut = cuts_[at];
    const auto& path = net_.removable_between(cut / 3, patch_.twin[cut] / 3);
    const auto length = static_cast<std::uint32_t>(path.size());
    std::uint64_t trials = 1;
    for (int i = 0; i < folds_per_path && length > 0; ++i, ++trials) {
      const Swap swap{path[random_.below(length)], cut};
      const std::uint32_t above = net_.side_above(swap.below);
      if (try_swap(swap)) {
        cuts_[at] = std::min(above, patch_.twin[above]);
        remember();
        break;
      }
    }
    return trials;
  }

  bool try_swap(const Swap& swap) {
    const double may_cost = -heat_ * std::log(1.0 - random_.unit());
    const std::optional<double> change = energy_.rate(swap, may_cost + least_slack + slack_of_heat * heat_);
    if (!change) {
      return false;
    }
    const auto limit = static_cast<std::int64_t>(std::floor((may_cost - *change) / price_)) + 1;
    if ((limit <= 0 && pairs_.total() == 0) || pairs_.added(swap.below, swap.side, limit) >= limit) {
      energy_.drop();
      return false;
    }
    pairs_.swap(swap.below, swap.side);
    energy_.keep();
    return true;
  }

  void remember() {
    if (pairs_.total() == 0 && energy_.total() < least_ - better_by && energy_.all_fit()) {
      least_ = energy_.total();
      best_ = net_.folds();
    }
  }

  const Patch& patch_;
  RootedNet& net_;
  OverlapPairs pairs_;
  NetEnergy& energy_;
  std::vector<std::uint32_t> cuts_;
  Random random_;
  double heat_ = 0.0;
  double price_ = 0.0;
  double least_ = HUGE_VAL;
  std::optional<Folds> best_;
};

/// The exact half: tabs as they are, no overlap.
class ExactWalk {
 public:
  ExactWalk(ChangingNet& net, NetEnergy& energy, double bare, std::uint64_t seed)
      : patch_(net.patch()),
        net_(net),
        energy_(energy),
        bare_(bare),
        cuts_(cuts_of(patch_, net.folds())),
        random_(seed) {
    least_ = total();
    best_ = net_.folds();
  }

  Folds run(const Annealing& rules, const Context& context) {
    for (std::uint64_t trial = 0; trial < rules.exact_trials && !cuts_.empty(); ++trial) {
      if (trial % paths_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      heat_ = between(rules.exact_heat, rules.last_heat, trial, rules.exact_trials);
      if (try_path(draw_cut())) {
        remember();
      }
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] double total() { return energy_.total_without_bare() - bare_ * net_.tab_worth(); }

  std::uint32_t draw_cut() {
    const auto count = static_cast<std::uint32_t>(cuts_.size());
    std::uint32_t at = random_.below(count);
    if (random_.unit() < chosen_share) {
      for (int draw = 0; draw < draws && net_.tab_state().has_tab(cuts_[at]) &&
                         !energy_.cut_costs().is_uneven(cuts_[at]);
           ++draw) {
        at = random_.below(count);
      }
    }
    return at;
  }

  bool try_path(std::uint32_t at) {
    const std::uint32_t cut = cuts_[at];
    const auto& path = net_.tree().removable_between(cut / 3, patch_.twin[cut] / 3);
    const auto length = static_cast<std::uint32_t>(path.size());
    for (int i = 0; i < folds_per_path && length > 0; ++i) {
      const Swap swap{path[random_.below(length)], cut};
      const double may_cost = -heat_ * std::log(1.0 - random_.unit());
      const std::optional<double> change = energy_.rate(swap, may_cost + exact_slack);
      if (!change) {
        continue;
      }
      if (*change > may_cost + exact_slack || !net_.is_clean(swap)) {
        energy_.drop();
        continue;
      }
      const std::uint32_t above = net_.tree().side_above(swap.below);
      const double before = net_.tab_worth();
      net_.make_with_tabs(swap);
      const double exact = *change - energy_.rated_bare() - bare_ * (net_.tab_worth() - before);
      if (exact > may_cost) {
        net_.take_back();
        energy_.drop();
        return false;
      }
      net_.keep();
      energy_.keep();
      cuts_[at] = std::min(above, patch_.twin[above]);
      return true;
    }
    return false;
  }

  void remember() {
    if (total() < least_ - better_by && energy_.all_fit()) {
      least_ = total();
      best_ = net_.folds();
    }
  }

  const Patch& patch_;
  ChangingNet& net_;
  NetEnergy& energy_;
  double bare_;
  std::vector<std::uint32_t> cuts_;
  Random random_;
  double heat_ = 0.0;
  double least_ = HUGE_VAL;
  Folds best_;
};

}  // namespace

void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context) {
  Random random(seed);
  const Folds given = net.folds();
  NetEnergy energy(net.patch(), net.tree(), facts, room, weights);
  std::optional<Folds> found = QuickWalk(net, energy, random.next()).run(rules, context);
  net.set_tree(found ? *found : given);
  if (!net.is_clean()) {
    net.set_tree(given);
  }
  if (!net.has_tabs() || rules.exact_trials == 0) {
    return;
  }
  const Folds start = net.folds();
  energy.set_tree();
  net.set_tree(ExactWalk(net, energy, weights.bare, random.next()).run(rules, context));
  if (!net.is_clean()) {
    net.set_tree(start);
  }
}

}  // namespace ridgecraft::unfold
