// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of whole segmentations and of their steps have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "segment/segment.hpp"

namespace ridgecraft::test {

/// The concavity that parts may have, of the radius of the smallest ball around the surface.
inline constexpr double tolerance = 0.1;

/// The part of each face, as a number.
[[nodiscard]] inline std::vector<std::uint32_t> labels_of(const segment::Segmentation& s) {
  std::vector<std::uint32_t> labels;
  for (const PartId p : s.part) {
    labels.push_back(p.value());
  }
  return labels;
}

}  // namespace ridgecraft::test
