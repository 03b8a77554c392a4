// SPDX-License-Identifier: GPL-3.0-or-later
// A walk through the trees of a net by swaps of a cut and a fold: what is drawn, and what is made together.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// Paths between two looks at the clock.
inline constexpr std::uint64_t paths_per_look = 64;
/// A tree is better by more than this, mm: less is rounding.
inline constexpr double better_by = 1e-6;

/// A net that is walked through: how a swap is made, and what it then costs, is up to those that derive from
/// it.
class Walk {
 public:
  /// Net and energy must outlive this, and be of one tree.
  Walk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed);
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;
  virtual ~Walk() = default;

 protected:
  /// Makes a swap that costs no more than `most`, mm, and says what it costs; nothing, and no change, where
  /// it costs more or can't be made.
  virtual std::optional<double> make(const Swap& swap, double most) = 0;
  /// Makes the swap that takes the last one back.
  virtual void unmake(const Swap& back) = 0;
  [[nodiscard]] virtual bool lacks_tab(std::uint32_t cut) = 0;

  /// Whether there is nothing to swap.
  [[nodiscard]] bool done() const { return cuts_.empty(); }

  /// Tries to make a cut a fold, until a swap is accepted: one that costs d, mm, is with probability
  /// exp(-d / heat).
  bool step(double heat, std::uint64_t& trials);

  const Patch& patch_;
  ChangingNet& net_;
  NetEnergy& energy_;

 private:
  [[nodiscard]] std::uint32_t draw_cut();
  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const;
  void exchange(std::uint32_t cut, std::uint32_t fold);
  [[nodiscard]] std::optional<Swap> mirror_image(const Swap& swap) const;
  [[nodiscard]] std::optional<Swap> swap_of(std::uint32_t fold, std::uint32_t cut) const;
  bool make_one(const Swap& swap, double may_cost);
  bool make_both(const Swap& swap, const Swap& image, double may_cost);

  std::vector<std::uint32_t> cuts_;   ///< the smaller side of each
  std::vector<std::uint32_t> place_;  ///< in cuts_, per smaller side
  std::vector<std::uint32_t> path_;   ///< space to work in
  Random random_;
};

}  // namespace ridgecraft::unfold
