// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/quick_walk.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ridgecraft::unfold {
namespace {

/// Heat at the end, mm.
constexpr double last_heat = 0.5;
/// Cost of an overlap, mm, at first and at last.
constexpr double first_overlap_price = 20.0;
constexpr double last_overlap_price = 1000.0;
/// Most trials of an ordinary net end at the angles. Where all are measured, as while a spiky body has
/// overlaps, the walk is as much shorter: faces measured for each trial, at most.
constexpr double work_per_trial = 40.0;
/// Cost of two faces that meet while the piece is folded, mm, at first and at last.
constexpr double first_meeting_price = 10.0;
constexpr double last_meeting_price = 100.0;
/// Mirror images count so many times as much where the exact half follows, which gives up what isn't worth
/// it: a walk that begins hot comes to rest uneven where an even net costs no more.
constexpr double mirror_times = 2.0;
/// A swap whose cuts cost more than may be spent is looked at no closer, but for so much, mm, and so many
/// times the heat: its shape may make up for it.
constexpr double least_slack = 4.0;
constexpr double slack_of_heat = 2.0;

/// How many pairs more than none may come for so much, one too many: negative where some must go.
std::int64_t limit_of(double may_cost, double price) {
  return static_cast<std::int64_t>(std::floor(may_cost / price)) + 1;
}

}  // namespace

QuickWalk::QuickWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, std::uint64_t seed)
    : Walk(net, energy, seed),
      pairs_(net.tree(), net.tolerance()),
      meetings_(meetings),
      has_tabs_(net.has_tabs()) {
  pairs_.find_all();
  if (meetings_ != nullptr) {
    meetings_->count(net.tree());
  }
}

std::optional<Folds> QuickWalk::run(const Annealing& rules, const Context& context) {
  if (has_tabs_ && rules.exact_trials > 0) {
    energy_.weigh_mirror(mirror_times);
  }
  if (is_allowed()) {
    least_ = energy_.total();
  }
  std::uint64_t paths = 0;
  const auto trials = static_cast<double>(rules.quick_trials);
  const auto spent = [&](std::uint64_t trial) {
    return std::max(static_cast<double>(trial), static_cast<double>(energy_.work()) / work_per_trial) /
           trials;
  };
  for (std::uint64_t trial = 0; rules.quick_trials > 0 && spent(trial) < 1.0 && !done();) {
    if (paths++ % paths_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        break;
      }
    }
    heat_ = between(rules.first_heat, last_heat, spent(trial));
    overlap_price_ = between(first_overlap_price, last_overlap_price, spent(trial));
    meeting_price_ = between(first_meeting_price, last_meeting_price, spent(trial));
    if (step(heat_, trial)) {
      remember();
      if (rules.until_it_fits && best_) {
        break;
      }
    }
  }
  energy_.weigh_mirror(1.0);
  return std::move(best_);
}

// What is cheap to ask is asked first: angles, shape, overlap, folding.
std::optional<double> QuickWalk::make(const Swap& swap, double most) {
  // No swap wins back more than all pairs cost.
  const double meetings =
      meetings_ != nullptr ? meeting_price_ * static_cast<double>(meetings_->total()) : 0.0;
  const double pairs = meetings + overlap_price_ * static_cast<double>(pairs_.total());
  const std::optional<double> change = energy_.rate(swap, most + least_slack + slack_of_heat * heat_ + pairs);
  if (!change) {
    return std::nullopt;
  }
  const std::int64_t overlaps = limit_of(most + meetings - *change, overlap_price_);
  const std::int64_t added =
      overlaps <= 0 && pairs_.total() == 0 ? overlaps : pairs_.added(swap.below, swap.side, overlaps);
  if (added >= overlaps) {
    energy_.drop();
    return std::nullopt;
  }
  double cost = *change + overlap_price_ * static_cast<double>(added);
  if (meetings_ != nullptr) {
    const auto before = static_cast<std::int64_t>(meetings_->total());
    const std::int64_t limit = before + limit_of(most - cost, meeting_price_);
    const auto after =
        limit <= 0
            ? limit
            : static_cast<std::int64_t>(meetings_->after(net_.tree(), swap, static_cast<std::size_t>(limit)));
    if (after >= limit) {
      energy_.drop();
      return std::nullopt;
    }
    cost += meeting_price_ * static_cast<double>(after - before);
    meetings_->keep(net_.tree());
  }
  pairs_.swap(swap.below, swap.side);
  energy_.keep();
  return cost;
}

void QuickWalk::unmake(const Swap& back) {
  static_cast<void>(energy_.rate(back, HUGE_VAL));
  if (meetings_ != nullptr) {
    static_cast<void>(meetings_->after(net_.tree(), back, std::numeric_limits<std::size_t>::max()));
    meetings_->keep(net_.tree());
  }
  pairs_.swap(back.below, back.side);
  energy_.keep();
}

bool QuickWalk::lacks_tab(std::uint32_t cut) {
  return energy_.cut_costs().lacks_tab(cut);
}

void QuickWalk::remember() {
  if (is_allowed() && energy_.total() < least_ - better_by && energy_.all_fit()) {
    least_ = energy_.total();
    best_ = net_.folds();
  }
}

}  // namespace ridgecraft::unfold
