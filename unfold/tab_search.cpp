// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_search.hpp"

#include <algorithm>
#include <cmath>

#include "unfold/tab_state.hpp"

namespace ridgecraft::unfold {

namespace {

/// Trials between two looks at the clock.
constexpr std::uint64_t trials_per_look = 16;
/// Folds of a path that are tested for a clean swap, at most.
constexpr std::size_t folds_per_trial = 12;

class Search {
 public:
  Search(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch, const Folds& folds,
         const TabOptions& options, const TabSearch& search, std::uint64_t seed)
      : patch_(patch),
        search_(search),
        random_(seed),
        net_(patch, search.tolerance, random_.next()),
        state_((net_.set_tree(folds), surface), panels, patch, net_, options) {}

  TabSearchResult run(const Context& context) {
    state_.renew_all();
    TabSearchResult result;
    result.folds = net_.folds();
    result.tabs_before = result.tabs = state_.tabs();
    find_missing();
    result.cuts = state_.tabs() + static_cast<std::uint32_t>(missing_.size()) + missing_seams_;
    for (; result.trials < search_.trials && !missing_.empty(); ++result.trials) {
      if (result.trials % trials_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      if (!step(missing_[random_.below(static_cast<std::uint32_t>(missing_.size()))])) {
        continue;
      }
      find_missing();
      if (state_.tabs() > result.tabs && (!search_.allowed || search_.allowed(net_.folds()))) {
        result.tabs = state_.tabs();
        result.folds = net_.folds();
      }
    }
    return result;
  }

 private:
  void find_missing() {
    missing_.clear();
    missing_seams_ = 0;
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      if (state_.is_cut(side) && state_.join_of(side) == side && !state_.has_tab(side)) {
        if (patch_.twin[side] == nothing) {
          ++missing_seams_;
        } else {
          missing_.push_back(side);
        }
      }
    }
  }

  /// Makes the cut a fold and a fold a cut; true when the tree has changed.
  bool step(std::uint32_t side) {
    const std::uint32_t below = choose_fold(side);
    if (below == nothing) {
      return false;
    }
    const std::uint32_t removed = net_.side_above(below);
    const std::uint32_t before = state_.tabs();
    touched_ = {side / 3, patch_.twin[side] / 3, removed / 3, patch_.twin[removed] / 3};
    net_.add_near_across(below, state_.reach(), touched_);
    const std::uint32_t moved = net_.swap(below, side);
    net_.add_near_across(moved, state_.reach(), touched_);
    state_.begin();
    state_.renew(touched_);
    if (accept(static_cast<double>(state_.tabs()) - static_cast<double>(before))) {
      return true;
    }
    net_.swap(moved, removed);
    state_.roll_back();
    return false;
  }

  /// A clean fold to remove, by preference one from which a tab may grow.
  std::uint32_t choose_fold(std::uint32_t side) {
    std::vector<std::uint32_t> path = net_.removable_between(side / 3, patch_.twin[side] / 3);
    struct Rated {
      double rating;
      std::uint32_t below;
    };
    std::vector<Rated> rated;
    rated.reserve(path.size());
    for (const std::uint32_t below : path) {
      const std::uint32_t above = net_.side_above(below);
      rated.push_back(
          {state_.chances(above) + 0.02 * std::fmin(patch_.length[above], 50.0) + 1.5 * random_.unit(),
           below});
    }
    const std::size_t count = std::min(folds_per_trial, rated.size());
    std::partial_sort(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(count), rated.end(),
                      [](const Rated& a, const Rated& b) {
                        return a.rating != b.rating ? a.rating > b.rating : a.below < b.below;
                      });
    for (std::size_t i = 0; i < count; ++i) {
      if (state_.chances(net_.side_above(rated[i].below)) > 0 && net_.swap_is_clean(rated[i].below, side)) {
        return rated[i].below;
      }
    }
    return nothing;
  }

  /// Never worse but sometimes: probability 0.5 exp(-d / 0.3) for d tabs fewer.
  bool accept(double gain) { return gain >= 0.0 || random_.unit() < 0.5 * std::exp(gain / 0.3); }

  const Patch& patch_;
  const TabSearch& search_;
  Random random_;
  TreeSearch net_;
  TabState state_;
  std::vector<std::uint32_t> missing_;  // cuts inside the patch that have no tab
  std::uint32_t missing_seams_ = 0;
  std::vector<std::uint32_t> touched_;
};

}  // namespace

TabSearchResult search_tabs(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                            const Folds& folds, const TabOptions& options, const TabSearch& search,
                            std::uint64_t seed, const Context& context) {
  return Search(surface, panels, patch, folds, options, search, seed).run(context);
}

}  // namespace ridgecraft::unfold
