// SPDX-License-Identifier: GPL-3.0-or-later
// One page of the packer: a bitmap of what is taken, the bitmaps of pieces, and the search for the lowest
// free place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "export/packing/packing_shape.hpp"

namespace ridgecraft::export_ {

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

/// Size of the area in mm and in cells.
struct PackingGrid {
  Vec2 area;
  double cell = 1.0;
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::size_t words = 0;  ///< 64 columns each, for a row

  PackingGrid(Vec2 area_mm, double cell_mm);
};

/// How many whole cells a shape of this size can be moved along a side.
[[nodiscard]] std::int32_t cells_of_room(double side, double size, double cell);

/// A place for a raster: the cell in which its lower left corner comes to lie.
struct Spot {
  std::int32_t column = 0;
  std::int32_t row = 0;
};

class PackingPage {
 public:
  explicit PackingPage(const PackingGrid& grid);

  /// The lowest free place (the leftmost or rightmost of these) whose upper edge lies below `limit` mm.
  /// `work` is raised by the number of words read, which is how the packer measures time.
  [[nodiscard]] std::optional<Spot> find(const Raster& raster, double limit, bool leftmost,
                                         std::uint64_t& work) const;
  void take(const Raster& raster, Spot spot);

 private:
  const PackingGrid* grid_;
  /// For each row and k below `levels`: where a run of 2^k cells that begins at a column meets a taken cell.
  /// Any run is two of these that overlap, so asking for a run costs the same whatever its length (a sparse
  /// table, row by row).
  std::size_t levels_;
  std::vector<std::uint64_t> meets_;
};

}  // namespace ridgecraft::export_
