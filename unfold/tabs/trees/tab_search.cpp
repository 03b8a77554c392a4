// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/tab_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/random.hpp"
#include "unfold/patch/linked_patch.hpp"
#include "unfold/tabs/trees/quick_search.hpp"

namespace ridgecraft::unfold {

namespace {

/// Below this there is no other tree worth looking at.
constexpr std::uint32_t smallest_piece = 4;
/// Trials between two looks at the clock.
constexpr std::uint64_t trials_per_look = 16;
/// Trials of the quick search (quick_search.hpp) for each one of this.
constexpr std::uint64_t quick_trials = 50;
/// Folds of a path that are tested for a clean swap, at most.
constexpr std::size_t folds_per_trial = 12;
/// Share of the trials that begin at a cut without a tab. Most begin at any cut: what stands in the way of a
/// tab is often a cut that has one.
constexpr double missing_share = 0.2;
/// A change that loses tabs worth d is accepted with probability exp(-d / heat); the heat falls from trial to
/// trial.
constexpr double first_heat = 0.2;
constexpr double last_heat = 0.15;
/// Worth of tabs by which angles alone may be wrong: by more, a swap isn't looked at any closer.
constexpr double angles_err = 0.5;
/// Trees that may not be the best, one after the other, after which none is asked about: the walk has left
/// what is allowed.
constexpr unsigned most_refused = 24;

/// Simulated annealing over clean swaps.
class Search {
 public:
  Search(ChangingNet& net, const TabSearch& search, std::uint64_t seed)
      : patch_(net.patch()), search_(search), random_(seed), net_(net) {}

  TabSearchResult run(const Context& context) {
    TabSearchResult result;
    result.tabs_before = net_.tabs();
    if (search_.trials > 0) {
      start(context);
    }
    result.folds = net_.folds();
    result.tabs = net_.tabs();
    double best = net_.tab_worth();
    find_cuts();
    result.cuts = static_cast<std::uint32_t>(cuts_.size()) + seams_;
    for (; result.trials < search_.trials && !missing_.empty(); ++result.trials) {
      if (result.trials % trials_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      const double progress = static_cast<double>(result.trials) / static_cast<double>(search_.trials);
      if (!step(first_heat * std::pow(last_heat / first_heat, progress))) {
        continue;
      }
      find_cuts();
      if (net_.tab_worth() > best && may_be_best()) {
        best = net_.tab_worth();
        result.tabs = net_.tabs();
        result.folds = net_.folds();
      }
    }
    net_.set_tree(result.folds);
    return result;
  }

 private:
  /// Goes on from what the quick search finds, if that is better.
  void start(const Context& context) {
    const Folds given = net_.folds();
    const double worth = net_.tab_worth();
    const auto allowed = [this](const Folds& folds) {
      return (!search_.allowed || search_.allowed(folds)) && may_be_best();
    };
    const std::optional<Folds> found =
        find_tab_start(patch_, net_.wedges(), net_.tree(), net_.tolerance(), quick_trials * search_.trials,
                       allowed, random_.next(), context);
    refused_ = 0;
    net_.set_tree(found ? *found : given);
    if (net_.tab_worth() <= worth) {
      net_.set_tree(given);
    }
  }

  [[nodiscard]] bool may_be_best() {
    if (!search_.best_allowed) {
      return true;
    }
    const bool allowed = refused_ < most_refused && search_.best_allowed(net_.folds());
    refused_ = allowed ? 0 : refused_ + 1;
    return allowed;
  }

  void find_cuts() {
    cuts_.clear();
    missing_.clear();
    seams_ = 0;
    const TabState& tabs = net_.tab_state();
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      if (!tabs.is_cut(side) || tabs.join_of(side) != side) {
        continue;
      }
      if (patch_.twin[side] == nothing) {
        ++seams_;
        continue;
      }
      cuts_.push_back(side);
      if (!tabs.has_tab(side)) {
        missing_.push_back(side);
      }
    }
  }

  /// Makes a cut a fold and a fold a cut; true when the tree has changed. What may be lost is drawn first, so
  /// that most swaps are refused by angles alone.
  bool step(double heat) {
    const double may_lose = -heat * std::log(1.0 - random_.unit());
    const std::uint32_t side = draw(random_.unit() < missing_share ? missing_ : cuts_, random_);
    const std::uint32_t below = choose_fold(side, may_lose + angles_err);
    if (below == nothing) {
      return false;
    }
    const double before = net_.tab_worth();
    net_.make_with_tabs({below, side});
    if (before - net_.tab_worth() <= may_lose && (!search_.allowed || search_.allowed(net_.folds()))) {
      net_.keep();
      return true;
    }
    net_.take_back();
    return false;
  }

  /// A clean fold on the path between the faces of a cut, by preference one from which a tab may grow, that
  /// takes the room of no more tabs than `may_lose` are worth.
  std::uint32_t choose_fold(std::uint32_t side, double may_lose) {
    struct Rated {
      double rating;
      std::uint32_t below;
    };
    std::vector<Rated> rated;
    for (const std::uint32_t below : net_.tree().removable_between(side / 3, patch_.twin[side] / 3)) {
      const std::uint32_t chances = net_.tab_state().chances(net_.tree().side_above(below));
      if (chances > 0 && net_.room_lost({below, side}) <= may_lose) {
        rated.push_back({chances + chance_spread * random_.unit(), below});
      }
    }
    const std::size_t count = std::min(folds_per_trial, rated.size());
    std::partial_sort(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(count), rated.end(),
                      [](const Rated& a, const Rated& b) {
                        return a.rating != b.rating ? a.rating > b.rating : a.below < b.below;
                      });
    for (std::size_t i = 0; i < count; ++i) {
      if (net_.is_clean({rated[i].below, side})) {
        return rated[i].below;
      }
    }
    return nothing;
  }

  /// How far chance outweighs that a tab may grow from both sides instead of one.
  static constexpr double chance_spread = 8.0;

  const Patch& patch_;
  const TabSearch& search_;
  Random random_;
  ChangingNet& net_;
  std::vector<std::uint32_t> cuts_;     // inside the patch
  std::vector<std::uint32_t> missing_;  // those that have no tab
  unsigned refused_ = 0;                // by may_be_best, one after the other
  std::uint32_t seams_ = 0;             // cuts to other patches that should have their tab here
};

}  // namespace

TabSearchResult search_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                            const Folds& folds, const TabOptions& options, const TabSearch& search,
                            std::uint64_t seed, const Context& context) {
  Random random(seed);
  // The sequence is used from its second number on: nets that people have already come from there.
  static_cast<void>(random.next());
  if (search.links.empty()) {
    ChangingNet net(surface, panels, patch, folds, options, search.tolerance);
    return search_tabs(net, search, random.next(), context);
  }
  const LinkedPatch linked = linked_patch(patch, search.links);
  TabSearch within = search;
  const auto unlinked = [&](const Folds& tree) {
    Folds forest = tree;
    for (const std::uint32_t side : search.links) {
      forest[side] = forest[patch.twin[side]] = 0;
    }
    return forest;
  };
  if (search.allowed) {
    within.allowed = [&](const Folds& tree) { return search.allowed(unlinked(tree)); };
  }
  if (search.best_allowed) {
    within.best_allowed = [&](const Folds& tree) { return search.best_allowed(unlinked(tree)); };
  }
  ChangingNet net(surface, panels, linked.apart, linked.joined, folds, options, search.tolerance);
  TabSearchResult result = search_tabs(net, within, random.next(), context);
  result.folds = unlinked(result.folds);
  return result;
}

TabSearchResult search_tabs(ChangingNet& net, const TabSearch& search, std::uint64_t seed,
                            const Context& context) {
  return Search(net, search, seed).run(context);
}

void improve_tabs(ChangingNet& net, const TabSearch& search, std::uint64_t seed, const Context& context) {
  if (net.patch().size() < smallest_piece || context.out_of_time()) {
    return;
  }
  const Folds given = net.folds();
  const TabSearchResult found = search_tabs(net, search, seed, context);
  // As everywhere: the search counts by small steps, only a fresh layout may call a net clean.
  if (found.tabs <= found.tabs_before || !net.is_clean()) {
    net.set_tree(given);
  }
}

}  // namespace ridgecraft::unfold
