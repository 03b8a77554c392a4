// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/tab_search.hpp"

#include <algorithm>
#include <cmath>

#include "unfold/search/linked_patch.hpp"
#include "unfold/tabs/tab_start.hpp"
#include "unfold/tabs/tab_state.hpp"

namespace ridgecraft::unfold {

namespace {

/// Trials between two looks at the clock.
constexpr std::uint64_t trials_per_look = 16;
/// Trials of the quick search (tab_start.hpp) for each one of this.
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

/// Simulated annealing over clean swaps.
class Search {
 public:
  /// `patch` and `joined` differ where pieces are searched together (linked_patch.hpp).
  Search(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch, const Patch& joined,
         const Folds& folds, const TabOptions& options, const TabSearch& search, std::uint64_t seed)
      : patch_(patch),
        search_(search),
        random_(seed),
        net_(joined, search.tolerance, random_.next()),
        clearance_(options.clearance_mm),
        state_((net_.set_tree(folds), surface), panels, patch, net_, options) {}

  TabSearchResult run(const Context& context) {
    state_.renew_all();
    TabSearchResult result;
    result.tabs_before = state_.tabs();
    if (search_.trials > 0) {
      start(context);
    }
    result.folds = net_.folds();
    result.tabs = state_.tabs();
    double best = state_.worth();
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
      if (state_.worth() > best) {
        best = state_.worth();
        result.tabs = state_.tabs();
        result.folds = net_.folds();
      }
    }
    return result;
  }

 private:
  /// Goes on from what the quick search finds, if that is better.
  void start(const Context& context) {
    const Folds given = net_.folds();
    const double worth = state_.worth();
    TabWedges wedges(patch_, state_.candidates(), state_.seams(), clearance_);
    const std::optional<Folds> found = find_tab_start(patch_, wedges, net_, quick_trials * search_.trials,
                                                      search_.allowed, random_.next(), context);
    if (found) {
      net_.set_tree(*found);
      state_.renew_all();
    }
    if (!found || state_.worth() <= worth) {
      net_.set_tree(given);
      state_.renew_all();
    }
  }

  void find_cuts() {
    cuts_.clear();
    missing_.clear();
    seams_ = 0;
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      if (!state_.is_cut(side) || state_.join_of(side) != side) {
        continue;
      }
      if (patch_.twin[side] == nothing) {
        ++seams_;
        continue;
      }
      cuts_.push_back(side);
      if (!state_.has_tab(side)) {
        missing_.push_back(side);
      }
    }
  }

  std::uint32_t draw(const std::vector<std::uint32_t>& sides) {
    return sides[random_.below(static_cast<std::uint32_t>(sides.size()))];
  }

  /// Makes a cut a fold and a fold a cut; true when the tree has changed.
  bool step(double heat) {
    const std::uint32_t side = draw(random_.unit() < missing_share ? missing_ : cuts_);
    const std::uint32_t below = choose_fold(side);
    if (below == nothing) {
      return false;
    }
    const double before = state_.worth();
    state_.swap(below, side);
    const double loss = before - state_.worth();
    if ((loss <= 0.0 || random_.unit() < std::exp(-loss / heat)) &&
        (!search_.allowed || search_.allowed(net_.folds()))) {
      return true;
    }
    state_.take_back();
    return false;
  }

  /// A clean fold on the path between the faces of a cut, by preference one from which a tab may grow.
  std::uint32_t choose_fold(std::uint32_t side) {
    struct Rated {
      double rating;
      std::uint32_t below;
    };
    std::vector<Rated> rated;
    for (const std::uint32_t below : net_.removable_between(side / 3, patch_.twin[side] / 3)) {
      const std::uint32_t chances = state_.chances(net_.side_above(below));
      if (chances > 0) {
        rated.push_back({chances + chance_spread * random_.unit(), below});
      }
    }
    const std::size_t count = std::min(folds_per_trial, rated.size());
    std::partial_sort(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(count), rated.end(),
                      [](const Rated& a, const Rated& b) {
                        return a.rating != b.rating ? a.rating > b.rating : a.below < b.below;
                      });
    for (std::size_t i = 0; i < count; ++i) {
      if (net_.swap_is_clean(rated[i].below, side)) {
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
  TreeSearch net_;
  double clearance_;
  TabState state_;
  std::vector<std::uint32_t> cuts_;     // inside the patch
  std::vector<std::uint32_t> missing_;  // those that have no tab
  std::uint32_t seams_ = 0;             // cuts to other patches that should have their tab here
};

}  // namespace

TabSearchResult search_tabs(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                            const Folds& folds, const TabOptions& options, const TabSearch& search,
                            std::uint64_t seed, const Context& context) {
  if (search.links.empty()) {
    return Search(surface, panels, patch, patch, folds, options, search, seed).run(context);
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
  TabSearchResult result =
      Search(surface, panels, linked.apart, linked.joined, folds, options, within, seed).run(context);
  result.folds = unlinked(result.folds);
  return result;
}

}  // namespace ridgecraft::unfold
