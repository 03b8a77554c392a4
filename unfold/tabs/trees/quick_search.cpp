// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/quick_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {

namespace {

/// Paths between two looks at the clock.
constexpr std::uint64_t paths_per_look = 64;
/// Folds that are tried on one path: finding it takes as long as rating a few.
constexpr int folds_per_path = 10;
/// Share of the trials that begin at a cut without room, if a few draws find one.
constexpr double roomless_share = 0.5;
constexpr int draws = 8;
/// A cost d is accepted with probability exp(-d / heat). Both change from trial to trial by a constant
/// factor.
constexpr double first_quick_heat = 0.4;
constexpr double last_quick_heat = 0.06;
/// Cost of an overlap, in tabs.
constexpr double first_price = 1.0;
constexpr double last_price = 10.0;
/// Better than the best by less is rounding.
constexpr double better_by = 1e-6;

class Annealing {
 public:
  Annealing(const Patch& patch, TabWedges& wedges, RootedNet& net, double tolerance,
            const std::function<bool(const Folds&)>& allowed, std::uint64_t seed)
      : patch_(patch), wedges_(wedges), net_(net), pairs_(net, tolerance), allowed_(allowed), random_(seed) {
    pairs_.find_all();
    wedges_.set_tree(net_.folds());
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && side < twin && net_.folds()[side] == 0 && patch_.frozen[side] == 0) {
        cuts_.push_back(side);
      }
    }
  }

  std::optional<Folds> run(std::uint64_t trials, const Context& context) {
    std::uint64_t paths = 0;
    for (std::uint64_t trial = 0; trial < trials && !cuts_.empty();) {
      if (paths++ % paths_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          break;
        }
      }
      const double progress = static_cast<double>(trial) / static_cast<double>(trials);
      heat_ = first_quick_heat * std::pow(last_quick_heat / first_quick_heat, progress);
      price_ = first_price * std::pow(last_price / first_price, progress);
      trial += try_path(draw_cut());
    }
    return std::move(best_);
  }

 private:
  std::uint32_t draw_cut() {
    const auto count = static_cast<std::uint32_t>(cuts_.size());
    std::uint32_t at = random_.below(count);
    if (random_.unit() < roomless_share) {
      for (int draw = 0; draw < draws && wedges_.missing_on(cuts_[at]) <= 0.0; ++draw) {
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
      const std::uint32_t below = path[random_.below(length)];
      const std::uint32_t above = net_.side_above(below);
      const std::uint32_t fold = std::min(above, patch_.twin[above]);
      if (accepted(cut, fold, below)) {
        pairs_.swap(below, cut);
        wedges_.keep();
        cuts_[at] = fold;
        remember();
        break;
      }
      wedges_.drop();
    }
    return trials;
  }

  /// Rates the swap; how many overlaps it may add is known before they are counted.
  bool accepted(std::uint32_t cut, std::uint32_t fold, std::uint32_t below) {
    const double change = wedges_.change(cut, fold);
    const double may_cost = -heat_ * std::log(1.0 - random_.unit());
    const auto limit = static_cast<std::int64_t>(std::floor((may_cost - change) / price_)) + 1;
    return (limit > 0 || pairs_.total() > 0) && pairs_.added(below, cut, limit) < limit;
  }

  void remember() {
    if (pairs_.total() == 0 && wedges_.missing() < least_ - better_by &&
        (!allowed_ || allowed_(net_.folds()))) {
      least_ = wedges_.missing();
      best_ = net_.folds();
    }
  }

  const Patch& patch_;
  TabWedges& wedges_;
  RootedNet& net_;
  OverlapPairs pairs_;
  const std::function<bool(const Folds&)>& allowed_;
  Random random_;
  std::vector<std::uint32_t> cuts_;  ///< the smaller side of each
  double heat_ = 0.0;
  double price_ = 0.0;
  double least_ = std::numeric_limits<double>::infinity();
  std::optional<Folds> best_;
};

}  // namespace

std::optional<Folds> find_tab_start(const Patch& patch, TabWedges& wedges, RootedNet& net, double tolerance,
                                    std::uint64_t trials, const std::function<bool(const Folds&)>& allowed,
                                    std::uint64_t seed, const Context& context) {
  return Annealing(patch, wedges, net, tolerance, allowed, seed).run(trials, context);
}

}  // namespace ridgecraft::unfold
