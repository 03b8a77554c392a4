// SPDX-License-Identifier: GPL-3.0-or-later
// What a turned piece covers on the grid of a page.
#pragma once

#include <cstdint>
#include <vector>

#include "export/packing/packing_shape.hpp"

namespace ridgecraft::paper {

/// What a turned piece covers on a grid, with its lower left corner in the grid's origin.
struct Raster {
  /// Cells begin .. end-1 of a row.
  struct Run {
    std::int32_t row;
    std::int32_t begin;
    std::int32_t end;
  };
  Turn turn;
  Vec2 low;                 ///< lower left corner of the turned piece, before it is moved to the origin
  Vec2 size;                ///< mm
  std::vector<Run> solid;   ///< cells that the piece touches: the longest run, then those that say most
  std::vector<Run> padded;  ///< cells within the gap of it; rows and columns may be negative
};

/// Rows of cells of the given size (mm) that the turned shape touches, and those that it comes nearer to than
/// `gap`. Never leaves out a cell: two pieces have at least the gap between them where the solid cells of one
/// and the padded ones of the other have none in common.
[[nodiscard]] Raster rasterize(const PackingShape& shape, Turn turn, double cell, double gap);

}  // namespace ridgecraft::paper
