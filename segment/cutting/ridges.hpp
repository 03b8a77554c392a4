// SPDX-License-Identifier: GPL-3.0-or-later
// Convex ridges: sets of hull vertices whose bridges among themselves are low (docs/design/segmentation.md,
// "Ridges").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"

namespace ridgecraft::segment {

/// A ridge with a high bridge.
struct Ridge {
  std::vector<std::uint32_t> vertices;  ///< hull vertices, ascending
  /// Ends of high bridges among them, ascending, with the longest sub-valley from there to a separator.
  struct End {
    std::uint32_t vertex;
    double reach;
  };
  std::vector<End> ends;
  double diagonal = 0.0;  ///< of the axis-parallel box of its vertices
};

/// The active ridges of a measured part, ordered by their smallest hull vertex. At least two when a bridge is
/// high.
[[nodiscard]] std::vector<Ridge> find_ridges(const Measurement& measurement, std::span<const Vec3> points);

}  // namespace ridgecraft::segment
