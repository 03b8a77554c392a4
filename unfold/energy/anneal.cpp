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
/// Paths for each trial of the exact half, at most: most find no clean swap that is worth it.
constexpr std::uint64_t paths_per_trial = 10;
/// The same where tabs are looked at exactly: angles may be wrong by as much, mm.
constexpr double exact_slack = 15.0;
/// A swap that costs d, mm, is taken with probability exp(-d / heat). Heats at the beginning and the end of the
/// quick half and of the exact one, mm.
constexpr double first_heat = 20.0;
constexpr double middle_heat = 0.5;
constexpr double exact_heat = 1.0;
constexpr double last_heat = 0.3;
/// Nets of so many faces get all trials for each; those of more get as many in all as this power of their number:
/// each trial takes longer there, too.
constexpr double ordinary_faces = 250.0;
constexpr double growth = 0.4;
/// Trials of the quick half for each one of the exact half.
constexpr double quick_for_exact = 80.0;
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

/// A net that is walked through: how a swap is made, and what it then costs, is up to those that derive from it.
class Walk {
 public:
  Walk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed)
      : patch_(net.patch()),
        net_(net),
        energy_(energy),
        cuts_(cuts_of(patch_, net.folds())),
        place_(patch_.twin.size(), nothing),
        random_(seed) {
    for (std::uint32_t i = 0; i < cuts_.size(); ++i) {
      place_[cuts_[i]] = i;
    }
  }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;
  virtual ~Walk() = default;

 protected:
  /// Makes a swap that costs no more than `most`, mm, and says what it costs; nothing, and no change, where it
  /// costs more or can't be made.
  virtual std::optional<double> make(const Swap& swap, double most) = 0;
  /// Makes the swap that takes the last one back.
  virtual void unmake(const Swap& back) = 0;
  [[nodiscard]] virtual bool lacks_tab(std::uint32_t cut) = 0;

  [[nodiscard]] bool done() const { return cuts_.empty(); }

  /// Tries to make a cut a fold, until a swap is accepted.
  bool step(double heat, std::uint64_t& trials) {
    const std::uint32_t cut = cuts_[draw_cut()];
    // As sides: a step that is taken back may leave the tree hung from another root.
    path_.clear();
    for (const std::uint32_t below : net_.tree().removable_between(cut / 3, patch_.twin[cut] / 3)) {
      path_.push_back(net_.tree().side_above(below));
    }
    const auto length = static_cast<std::uint32_t>(path_.size());
    ++trials;
    for (int i = 0; i < folds_per_path && length > 0; ++i, ++trials) {
      const Swap swap = *swap_of(path_[random_.below(length)], cut);
      const double may_cost = -heat * std::log(1.0 - random_.unit());
      const std::optional<Swap> mirrored = mirror_image(swap);
      if (mirrored ? make_both(swap, *mirrored, may_cost) : make_one(swap, may_cost)) {
        return true;
      }
    }
    return false;
  }

  const Patch& patch_;
  ChangingNet& net_;
  NetEnergy& energy_;

 private:
  std::uint32_t draw_cut() {
    const auto count = static_cast<std::uint32_t>(cuts_.size());
    std::uint32_t at = random_.below(count);
    if (random_.unit() < chosen_share) {
      for (int draw = 0;
           draw < draws && !lacks_tab(cuts_[at]) && !energy_.cut_costs().is_uneven(cuts_[at]); ++draw) {
        at = random_.below(count);
      }
    }
    return at;
  }

  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const {
    return std::min(side, patch_.twin[side]);
  }

  void exchange(std::uint32_t cut, std::uint32_t fold) {
    const std::uint32_t at = place_[join_of(cut)];
    place_[join_of(cut)] = nothing;
    cuts_[at] = join_of(fold);
    place_[join_of(fold)] = at;
  }

  bool make_one(const Swap& swap, double may_cost) {
    const std::uint32_t fold = net_.tree().side_above(swap.below);
    if (!make(swap, may_cost)) {
      return false;
    }
    exchange(swap.side, fold);
    return true;
  }

  /// The mirror image of a swap, named as before that is made (its `below` is one of two faces still): where both
  /// edges have one that is what they are, but not each other.
  [[nodiscard]] std::optional<Swap> mirror_image(const Swap& swap) const {
    const CutCosts& costs = energy_.cut_costs();
    const std::uint32_t fold = net_.tree().side_above(swap.below);
    const std::uint32_t cut_image = costs.mirror_of(swap.side);
    const std::uint32_t fold_image = costs.mirror_of(fold);
    if (cut_image == nothing || fold_image == nothing || !costs.is_cut(cut_image) || costs.is_cut(fold_image) ||
        patch_.frozen[fold_image] != 0 || join_of(cut_image) == join_of(swap.side) ||
        join_of(fold_image) == join_of(fold)) {
      return std::nullopt;
    }
    return Swap{fold_image, cut_image};
  }

  /// Of a fold and a cut the swap, if it may be made now.
  [[nodiscard]] std::optional<Swap> swap_of(std::uint32_t fold, std::uint32_t cut) const {
    const RootedNet& tree = net_.tree();
    const std::uint32_t f = fold / 3;
    const std::uint32_t g = patch_.twin[fold] / 3;
    const std::uint32_t below = tree.side_above(f) == fold ? f : g;
    const bool here = tree.in_subtree(below, cut / 3);
    const bool there = tree.in_subtree(below, patch_.twin[cut] / 3);
    return here == there ? std::nullopt : std::optional<Swap>({below, cut});
  }

  bool make_both(const Swap& swap, const Swap& image, double may_cost) {
    // Alone it costs what makes the net uneven; that is won back by its image.
    const std::uint32_t fold = net_.tree().side_above(swap.below);
    const double uneven = energy_.cut_costs().mirror_price(swap.side) + energy_.cut_costs().mirror_price(fold);
    const std::optional<double> first = make(swap, uneven + std::max(0.0, may_cost) + least_slack);
    if (!first) {
      return false;
    }
    const std::optional<Swap> second = swap_of(image.below, image.side);
    if (!second || !make(*second, may_cost - *first)) {
      const std::optional<Swap> back = swap_of(join_of(swap.side), join_of(fold));
      unmake(*back);
      return false;
    }
    exchange(swap.side, fold);
    exchange(image.side, image.below);
    return true;
  }

  std::vector<std::uint32_t> cuts_;   ///< the smaller side of each
  std::vector<std::uint32_t> place_;  ///< in cuts_, per smaller side
  std::vector<std::uint32_t> path_;   ///< space to work in
  Random random_;
};

/// The quick half: tabs are told by angles, overlaps have a price.
class QuickWalk : public Walk {
 public:
  QuickWalk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed)
      : Walk(net, energy, seed), pairs_(net.tree(), net.tolerance()) {
    pairs_.find_all();
    if (pairs_.total() == 0) {
      least_ = energy_.total();
    }
  }

  std::optional<Folds> run(const Annealing& rules, const Context& context) {
    std::uint64_t paths = 0;
    for (std::uint64_t trial = 0; trial < rules.quick_trials && !done();) {
      if (paths++ % paths_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      heat_ = between(first_heat, middle_heat, trial, rules.quick_trials);
      price_ = between(first_price, last_price, trial, rules.quick_trials);
      if (step(heat_, trial)) {
        remember();
      }
    }
    return std::move(best_);
  }

 private:
  std::optional<double> make(const Swap& swap, double most) override {
    const std::optional<double> change = energy_.rate(swap, most + least_slack + slack_of_heat * heat_);
    if (!change) {
      return std::nullopt;
    }
    const auto limit = static_cast<std::int64_t>(std::floor((most - *change) / price_)) + 1;
    const std::int64_t added =
        limit <= 0 && pairs_.total() == 0 ? limit : pairs_.added(swap.below, swap.side, limit);
    if (added >= limit) {
      energy_.drop();
      return std::nullopt;
    }
    pairs_.swap(swap.below, swap.side);
    energy_.keep();
    return *change + price_ * static_cast<double>(added);
  }

  void unmake(const Swap& back) override {
    static_cast<void>(energy_.rate(back, HUGE_VAL));
    pairs_.swap(back.below, back.side);
    energy_.keep();
  }

  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override { return energy_.cut_costs().lacks_tab(cut); }

  void remember() {
    if (pairs_.total() == 0 && energy_.total() < least_ - better_by && energy_.all_fit()) {
      least_ = energy_.total();
      best_ = net_.folds();
    }
  }

  OverlapPairs pairs_;
  double heat_ = 0.0;
  double price_ = 0.0;
  double least_ = HUGE_VAL;
  std::optional<Folds> best_;
};

/// The exact half: tabs as they are, no overlap.
class ExactWalk : public Walk {
 public:
  ExactWalk(ChangingNet& net, NetEnergy& energy, double bare, std::uint64_t seed)
      : Walk(net, energy, seed), bare_(bare) {
    least_ = total();
    best_ = net_.folds();
  }

  Folds run(const Annealing& rules, const Context& context) {
    std::uint64_t paths = 0;
    made_ = 0;
    while (made_ < rules.exact_trials && paths < paths_per_trial * rules.exact_trials && !done()) {
      if (paths++ % paths_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      std::uint64_t trials = 0;
      if (step(between(exact_heat, last_heat, made_, rules.exact_trials), trials)) {
        remember();
      }
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] double total() { return energy_.total_without_bare() - bare_ * net_.held_mm(); }

  std::optional<double> make(const Swap& swap, double most) override {
    const std::optional<double> change = energy_.rate(swap, most + exact_slack);
    if (!change) {
      return std::nullopt;
    }
    if (*change > most + exact_slack || !net_.is_clean(swap)) {
      energy_.drop();
      return std::nullopt;
    }
    ++made_;
    const double before = net_.held_mm();
    net_.make_with_tabs(swap);
    const double exact = *change - energy_.rated_bare() - bare_ * (net_.held_mm() - before);
    if (exact > most) {
      net_.take_back();
      energy_.drop();
      return std::nullopt;
    }
    net_.keep();
    energy_.keep();
    return exact;
  }

  void unmake(const Swap& back) override {
    static_cast<void>(energy_.rate(back, HUGE_VAL));
    net_.make_with_tabs(back);
    net_.keep();
    energy_.keep();
  }

  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override { return !net_.tab_state().has_tab(cut); }

  void remember() {
    if (total() < least_ - better_by && energy_.all_fit()) {
      least_ = total();
      best_ = net_.folds();
    }
  }

  double bare_;
  std::uint64_t made_ = 0;  ///< swaps that were looked at with their tabs
  double least_ = HUGE_VAL;
  Folds best_;
};

}  // namespace

Annealing annealing_for(double trials_per_face, std::uint32_t faces) {
  const double more = std::max(1.0, static_cast<double>(faces) / ordinary_faces);
  const double trials = trials_per_face * static_cast<double>(faces) * std::pow(more, growth - 1.0);
  return {static_cast<std::uint64_t>(trials), static_cast<std::uint64_t>(trials / quick_for_exact)};
}

CutFacts cut_facts(const ChangingNet& net, const TabOptions& options) {
  CutFacts facts;
  if (net.has_tabs()) {
    const TabState& tabs = net.tab_state();
    facts = {tabs.candidates(), tabs.across(), tabs.seams(), options.clearance_mm, {}};
  }
  return facts;
}

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
