// SPDX-License-Identifier: GPL-3.0-or-later
// One page of the packer: a bitmap of what is taken, and the search for the lowest free place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "export/packing/packing_raster.hpp"

namespace ridgecraft::paper {

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

}  // namespace ridgecraft::paper
