// SPDX-License-Identifier: GPL-3.0-or-later
// Filling pages one shape after the other, and what comes of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "export/packing/packing_page.hpp"
#include "export/packing/packing_task.hpp"

namespace ridgecraft::paper {

/// Shapes in the order in which they get their places, and how.
struct Recipe {
  static constexpr std::uint32_t any_turn = UINT32_MAX;

  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> turn;  ///< of each shape: tried alone before all others are; any_turn for none
  bool together = false;            ///< on pages with shapes of its group first
  bool leftmost = false;            ///< fills rows from the left
  bool narrow = false;              ///< takes the narrowest turn that fits, not the one that lies lowest
};

struct Place {
  std::uint32_t page = UINT32_MAX;
  std::uint32_t turn = 0;
  Spot spot;
};

struct Arrangement {
  std::vector<Place> places;  ///< of each shape
  std::vector<PackingPage> pages;
  std::vector<double> used;  ///< area of paper on each page, mm2

  [[nodiscard]] bool empty() const { return used.empty(); }
  /// Fewer pages; then those more unequal in use, which are half way to a page less.
  [[nodiscard]] bool packs_better(const Arrangement& other) const;
};

/// How finely a page is looked at. Coarse grids cost room at each shape, and let many more arrangements be
/// tried in the same time.
struct PackingDetail {
  double cells = 300.0;    ///< along the side of a square as large as the page
  std::size_t turns = 16;  ///< of each shape, at most
};

/// The rasters of all shapes in all their turns, and the pages' grid.
class PackingFill {
 public:
  PackingFill(const PackingTask& task, const PackingDetail& detail, const Context& context);

  /// Places the shapes of the recipe on the pages of `base` (empty ones last) and new ones, each on the first
  /// page with room, as low as possible there (bottom-left: Baker, Coffman and Rivest 1980; bitmaps as in
  /// Burke et al. 2006).
  [[nodiscard]] Arrangement fill(Arrangement base, const Recipe& recipe);
  [[nodiscard]] Arrangement nothing() const;
  /// The arrangement with these places.
  [[nodiscard]] Arrangement placed(const std::vector<Place>& places) const;
  /// Without the shapes on those pages, which become empty; their shapes are added to `removed`, in ascending
  /// order.
  [[nodiscard]] Arrangement without(const Arrangement& a, const std::vector<std::uint32_t>& pages,
                                    std::vector<std::uint32_t>& removed) const;
  /// Moves one shape to another page if it has room.
  [[nodiscard]] bool move(Arrangement& a, std::uint32_t shape, std::uint32_t page);

  [[nodiscard]] const PackingTask& task() const { return *task_; }
  [[nodiscard]] const PackingGrid& grid() const { return grid_; }
  [[nodiscard]] double page_area() const { return task_->area.x * task_->area.y; }
  [[nodiscard]] const std::vector<Raster>& rasters(std::uint32_t shape) const { return rasters_[shape]; }
  /// Lower left corner, mm, of a shape placed there.
  [[nodiscard]] Vec2 corner(Spot spot) const { return {spot.column * grid_.cell, spot.row * grid_.cell}; }
  /// Words of bitmap read so far.
  [[nodiscard]] std::uint64_t work() const { return work_; }
  /// Pages that would be needed if nothing were lost but half the gap around each shape; an estimate from
  /// below.
  [[nodiscard]] std::size_t fewest_pages() const;
  /// Area of all shapes with half the gap around them, mm2.
  [[nodiscard]] double needed_area() const;

 private:
  [[nodiscard]] std::optional<Place> fit(const PackingPage& page, std::uint32_t shape, const Recipe& recipe);
  [[nodiscard]] std::optional<Place> lowest(const PackingPage& page, std::uint32_t shape, bool leftmost);
  [[nodiscard]] std::optional<Place> narrowest(const PackingPage& page, std::uint32_t shape, bool leftmost);
  void put(Arrangement& a, std::uint32_t shape, Place place) const;

  const PackingTask* task_;
  const Context* context_;
  PackingGrid grid_;
  std::vector<std::vector<Raster>> rasters_;
  std::vector<std::vector<std::uint32_t>> by_width_;  ///< turns of each shape, the narrowest first
  std::uint64_t work_ = 0;
};

}  // namespace ridgecraft::paper
