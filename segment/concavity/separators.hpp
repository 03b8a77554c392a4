// SPDX-License-Identifier: GPL-3.0-or-later
// Where a deep valley is cut: at one vertex of a V, at two of a U (docs/design/segmentation.md,
// "Separators").
#pragma once

#include <cstddef>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft::segment {

/// Positions in the valley; `first` belongs to its first end, `last` to its last; equal in a V.
struct Separators {
  std::size_t first = 0;
  std::size_t last = 0;
  bool v_shaped = true;
};

/// `chain` as project_valley makes it, at least 3 points; per point its concavity, capped and as it was
/// before the cap. O(n^2) at worst.
[[nodiscard]] Separators find_separators(std::span<const Vec2> chain, std::span<const double> capped,
                                         std::span<const double> uncapped, double tolerance);

}  // namespace ridgecraft::segment
