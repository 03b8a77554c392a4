// SPDX-License-Identifier: GPL-3.0-or-later
// The area that closed lines of a cut enclose.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace ridgecraft::test {

/// Of counterclockwise loops, less that of clockwise ones, mm^2.
[[nodiscard]] inline double loops_area(const std::vector<std::vector<Vec2>>& loops) {
  double sum = 0.0;
  for (const auto& loop : loops) {
    sum += 0.5 * doubled_area(loop);
  }
  return sum;
}

}  // namespace ridgecraft::test
