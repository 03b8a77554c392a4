// SPDX-License-Identifier: GPL-3.0-or-later
// Filling pages one shape after the other, and the search over orders: simple ones first, then a random walk
// that empties two pages and fills them again. Of all that it meets, people get the fewest pages, then the
// fullest ones, then groups that stay together.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "export/packing/packing_page.hpp"

namespace ridgecraft::export_ {

/// Shapes in the order in which they get their places, and how.
struct Recipe {
  std::vector<std::uint32_t> order;
  bool narrow = false;    ///< takes the narrowest turn that fits, not the one that lies lowest
  bool together = false;  ///< on pages with shapes of its group first
  bool leftmost = false;  ///< fills rows from the left
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
  /// Without the shapes on those pages, which become empty; their shapes are added to `removed`, in ascending
  /// order.
  [[nodiscard]] Arrangement without(const Arrangement& a, const std::vector<std::uint32_t>& pages,
                                    std::vector<std::uint32_t>& removed) const;
  /// Moves one shape to another page if it has room.
  [[nodiscard]] bool move(Arrangement& a, std::uint32_t shape, std::uint32_t page);

  [[nodiscard]] const PackingTask& task() const { return *task_; }
  [[nodiscard]] double page_area() const { return task_->area.x * task_->area.y; }
  [[nodiscard]] const std::vector<Raster>& rasters(std::uint32_t shape) const { return rasters_[shape]; }
  /// Lower left corner, mm, of a shape placed there.
  [[nodiscard]] Vec2 corner(Spot spot) const { return {spot.column * grid_.cell, spot.row * grid_.cell}; }
  /// Words of bitmap read so far.
  [[nodiscard]] std::uint64_t work() const { return work_; }
  /// Pages that would be needed if nothing were lost but half the gap around each shape; an estimate from
  /// below.
  [[nodiscard]] std::size_t fewest_pages() const;

 private:
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

/// What people would choose by, the most important first; smaller is better.
struct PackingMerit {
  std::size_t pages = SIZE_MAX;
  double evenness = 0.0;  ///< pages less the sum of their squared use: full pages and one that is nearly
                          ///< empty are better than all of them half full; in steps of same_use
  std::size_t splits = 0;
  double exact_evenness = 0.0;

  friend auto operator<=>(const PackingMerit&, const PackingMerit&) = default;
};

/// One search. The task and the context must outlive it.
class PackingSearch {
 public:
  PackingSearch(const PackingTask& task, const PackingDetail& detail, const Context& context)
      : task_(task), context_(context), fill_(task, detail, context), random_(context.seed) {}
  /// The best arrangement that a fixed amount of work finds; the walk ends where so few pages are enough.
  [[nodiscard]] std::vector<Packed> run(std::size_t enough_pages);
  /// Pages after the simple orders and a short walk.
  [[nodiscard]] std::size_t rough_page_count();
  /// What the simple orders find, if that is one page.
  [[nodiscard]] std::vector<Packed> run_for_one_page();

 private:
  using Order = std::vector<std::uint32_t>;
  [[nodiscard]] std::vector<Order> simple_orders() const;
  void start();
  void walk(std::size_t enough_pages, std::uint64_t work);
  [[nodiscard]] std::vector<Packed> result() const;
  [[nodiscard]] Arrangement refilled(const Arrangement& at);
  void offer(const Arrangement& candidate);
  [[nodiscard]] PackingMerit merit(const Arrangement& a) const;
  [[nodiscard]] std::size_t splits(const Arrangement& a) const;

  const PackingTask& task_;
  const Context& context_;
  PackingFill fill_;
  Random random_;
  Arrangement best_;   ///< as the search counts
  Arrangement shown_;  ///< as people would choose, among those with the fewest pages
};

}  // namespace ridgecraft::export_
