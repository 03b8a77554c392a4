// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/exact_walk.hpp"

#include <limits>
#include <utility>

namespace ridgecraft::unfold {
namespace {

/// Paths for each trial, at most: most find no clean swap that is worth it.
constexpr std::uint64_t paths_per_trial = 10;
/// Angles may be wrong about the tabs by as much, mm: what costs more than may be spent and this isn't looked
/// at.
constexpr double exact_slack = 15.0;
/// Heats at the beginning and the end, mm.
constexpr double exact_first_heat = 1.0;
constexpr double exact_last_heat = 0.3;

}  // namespace

ExactWalk::ExactWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, double bare,
                     std::uint64_t seed)
    : Walk(net, energy, seed), meetings_(meetings), bare_(bare) {
  least_ = total();
  best_ = net_.folds();
  if (meetings_ != nullptr) {
    meetings_->count(net.tree());
  }
}

Folds ExactWalk::run(const Annealing& rules, const Context& context) {
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
    const double spent = static_cast<double>(made_) / static_cast<double>(rules.exact_trials);
    if (step(between(exact_first_heat, exact_last_heat, spent), trials)) {
      remember();
    }
  }
  return std::move(best_);
}

bool ExactWalk::meets_no_more(const Swap& swap) {
  return meetings_ == nullptr ||
         meetings_->after(net_.tree(), swap, meetings_->total() + 1) <= meetings_->total();
}

std::optional<double> ExactWalk::make(const Swap& swap, double most) {
  const std::optional<double> change = energy_.rate(swap, most + exact_slack);
  if (!change) {
    return std::nullopt;
  }
  if (*change > most + exact_slack || !net_.is_clean(swap) || !meets_no_more(swap)) {
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
  if (meetings_ != nullptr) {
    meetings_->keep(net_.tree());
  }
  return exact;
}

void ExactWalk::unmake(const Swap& back) {
  static_cast<void>(energy_.rate(back, HUGE_VAL));
  if (meetings_ != nullptr) {
    static_cast<void>(meetings_->after(net_.tree(), back, std::numeric_limits<std::size_t>::max()));
    meetings_->keep(net_.tree());
  }
  net_.make_with_tabs(back);
  net_.keep();
  energy_.keep();
}

bool ExactWalk::lacks_tab(std::uint32_t cut) {
  return !net_.tab_state().has_tab(cut);
}

void ExactWalk::remember() {
  if (total() < least_ - better_by && energy_.all_fit()) {
    least_ = total();
    best_ = net_.folds();
  }
}

}  // namespace ridgecraft::unfold
