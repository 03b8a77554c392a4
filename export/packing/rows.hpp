// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that look alike lie side by side, so that a maker sees at once that there are several.
#pragma once

#include <cstdint>
#include <vector>

#include "base/motion.hpp"
#include "export/packing/packing.hpp"

namespace ridgecraft::paper {

/// Shapes of a task that look the same when each is moved so; mirrored ones are mirror images at x = 0.
struct AlikeShapes {
  std::vector<std::uint32_t> shapes;
  std::vector<Rigid> motion;   ///< of each shape
  std::vector<bool> mirrored;  ///< each shape
};

/// As pack(), with alike shapes in rows where that costs no page: rows with room for numbers between the
/// shapes before narrow ones. Kinds are left as they come, largest first, until the others do. A few times
/// the work.
[[nodiscard]] std::vector<Packed> pack_in_rows(const PackingTask& task, const std::vector<AlikeShapes>& kinds,
                                               const Context& context);

}  // namespace ridgecraft::paper
