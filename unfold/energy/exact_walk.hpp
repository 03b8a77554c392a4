// SPDX-License-Identifier: GPL-3.0-or-later
// The exact half of the search among trees: tabs as they are, no overlap, no meeting that wasn't there.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "base/context.hpp"
#include "unfold/energy/annealing.hpp"
#include "unfold/energy/walk.hpp"
#include "unfold/folding/folding_meetings.hpp"

namespace ridgecraft::unfold {

class ExactWalk : public Walk {
 public:
  /// `bare`: what a millimetre of seam without a tab costs. `meetings`, where given, are of the net's patch:
  /// no swap makes more of them. The net must have tabs.
  ExactWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, double bare, std::uint64_t seed);

  /// The best tree that it came to. Throws Error(interrupted).
  [[nodiscard]] Folds run(const Annealing& rules, const Context& context);

 private:
  std::optional<double> make(const Swap& swap, double most) override;
  void unmake(const Swap& back) override;
  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override;
  [[nodiscard]] double total() { return energy_.total_without_bare() - bare_ * net_.held_mm(); }
  [[nodiscard]] bool meets_no_more(const Swap& swap);
  void remember();

  FoldingMeetings* meetings_;
  double bare_;
  std::uint64_t made_ = 0;  ///< swaps that were looked at with their tabs
  double least_ = HUGE_VAL;
  Folds best_;
};

}  // namespace ridgecraft::unfold
