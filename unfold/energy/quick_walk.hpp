// SPDX-License-Identifier: GPL-3.0-or-later
// The quick half of the search among trees: tabs are told by angles, overlaps and meetings have a price.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "base/context.hpp"
#include "unfold/energy/annealing.hpp"
#include "unfold/energy/walk.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {

class QuickWalk : public Walk {
 public:
  /// `meetings`, where given, are of the net's patch: only trees without any are remembered.
  QuickWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, std::uint64_t seed);

  /// The best tree that it came to, mirror images counted twice where an exact walk follows; nothing where
  /// none is better than the one that it began with, if that was allowed. Throws Error(interrupted).
  [[nodiscard]] std::optional<Folds> run(const Annealing& rules, const Context& context);

 private:
  std::optional<double> make(const Swap& swap, double most) override;
  void unmake(const Swap& back) override;
  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override;
  [[nodiscard]] bool is_allowed() const {
    return pairs_.total() == 0 && (meetings_ == nullptr || meetings_->total() == 0);
  }
  void remember();

  OverlapPairs pairs_;
  FoldingMeetings* meetings_;
  bool has_tabs_;
  double heat_ = 0.0;
  double overlap_price_ = 0.0;
  double meeting_price_ = 0.0;
  double least_ = HUGE_VAL;
  std::optional<Folds> best_;
};

}  // namespace ridgecraft::unfold
