// SPDX-License-Identifier: GPL-3.0-or-later
// A folded piece is opened crease by crease: backwards, that is an order in which it can be folded.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_trial.hpp"

namespace ridgecraft::unfold {

/// How far opening came.
struct Opening {
  std::vector<std::uint32_t>
      opened;  ///< creases in the order in which they went flat; all where it succeeded
  /// Two faces that meet when one of the others is opened; nothing where there is none or the search was
  /// stopped at once.
  std::optional<FoldTrial::Pair> in_the_way = std::nullopt;
};

/// Opens the folded piece: of the creases that nothing keeps from lying flat one goes flat, and so on. Where
/// none is free before all are flat it begins again, and what was stuck comes earlier: some dozens of times,
/// within a budget of work that is about 0.2 s. What it ends with is the attempt that came farthest. Where
/// not one crease is free in the folded piece there is no order of single creases. Deterministic but for the
/// deadline.
[[nodiscard]] Opening open_piece(const FoldMotion& motion, FoldTrial& trial, const Context& context);

}  // namespace ridgecraft::unfold
