// SPDX-License-Identifier: GPL-3.0-or-later
// What is to be packed, and what comes back.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "export/packing/packing_shape.hpp"

namespace ridgecraft::paper {

struct PackingTask {
  std::vector<PackingShape> shapes;  ///< each fits the area in some turn
  std::vector<std::uint32_t> group;  ///< of each shape; those of one group had better be on one page
  Vec2 area;                         ///< of a page, mm
  double gap = 0.0;                  ///< between shapes, mm; none to the border of the area
};

/// Where a shape lies: turned, then moved; the area's lower left corner is the origin.
struct Packed {
  std::uint32_t page = 0;
  Turn turn;
  Vec2 shift;
};

}  // namespace ridgecraft::paper
