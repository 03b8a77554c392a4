// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the boxes of the plane that meet a box: a uniform grid in two flat arrays, built once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/boxes.hpp"

namespace ridgecraft {

/// Boxes 0 .. n-1, each listed in all cells that it meets. Cells are about as large as the mean box, and
/// never more than a few per box, so building is O(n) and a query O(answer) for boxes of similar size.
class BoxGrid {
 public:
  explicit BoxGrid(std::vector<Box2> boxes) : boxes_(std::move(boxes)) {
    double mean = 0.0;
    for (const Box2& box : boxes_) {
      all_.add(box.low);
      all_.add(box.high);
      mean += std::max(box.size().x, box.size().y);
    }
    const double n = static_cast<double>(std::max<std::size_t>(boxes_.size(), 1));
    const Vec2 size = boxes_.empty() ? Vec2{} : all_.size();
    // Two cells per box at most: a few large and many small boxes must not make millions of cells.
    cell_ =
        std::max(mean / n, std::max(std::sqrt(size.x * size.y / (2.0 * n)), (size.x + size.y) / (2.0 * n)));
    if (!(cell_ > 0.0)) {
      cell_ = 1.0;
    }
    columns_ = static_cast<std::uint32_t>(size.x / cell_) + 1;
    rows_ = static_cast<std::uint32_t>(size.y / cell_) + 1;
    fill();
  }

  /// Calls visit(i) once for each box i that meets `query`, in an order that depends on the boxes alone.
  template <class Visit>
  void visit(const Box2& query, Visit&& visit_box) const {
    if (boxes_.empty() || !meet(query, all_)) {
      return;
    }
    const Range range = cells(query);
    for (std::uint32_t y = range.low_y; y <= range.high_y; ++y) {
      for (std::uint32_t x = range.low_x; x <= range.high_x; ++x) {
        for (std::uint32_t k = first_[y * columns_ + x]; k < first_[y * columns_ + x + 1]; ++k) {
          const std::uint32_t i = items_[k];
          const Range own = cells(boxes_[i]);
          // A box that lies in several cells of the query is visited in the first one only.
          if (x == std::max(own.low_x, range.low_x) && y == std::max(own.low_y, range.low_y) &&
              meet(boxes_[i], query)) {
            visit_box(i);
          }
        }
      }
    }
  }

 private:
  struct Range {
    std::uint32_t low_x, low_y, high_x, high_y;
  };

  [[nodiscard]] static std::uint32_t clamp(double value, std::uint32_t count) {
    return value <= 0.0 ? 0 : static_cast<std::uint32_t>(std::min(static_cast<double>(count - 1), value));
  }
  [[nodiscard]] Range cells(const Box2& box) const {
    const Vec2 low = (box.low - all_.low) / cell_;
    const Vec2 high = (box.high - all_.low) / cell_;
    return {clamp(low.x, columns_), clamp(low.y, rows_), clamp(high.x, columns_), clamp(high.y, rows_)};
  }
  void fill() {
    first_.assign(std::size_t{columns_} * rows_ + 1, 0);
    each_cell([this](std::uint32_t cell, std::uint32_t) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) {
      first_[i] += first_[i - 1];
    }
    items_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_cell([this, &next](std::uint32_t cell, std::uint32_t i) { items_[next[cell]++] = i; });
  }
  template <class Use>
  void each_cell(Use&& use) const {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      const Range range = cells(boxes_[i]);
      for (std::uint32_t y = range.low_y; y <= range.high_y; ++y) {
        for (std::uint32_t x = range.low_x; x <= range.high_x; ++x) {
          use(y * columns_ + x, i);
        }
      }
    }
  }

  std::vector<Box2> boxes_;
  Box2 all_;
  double cell_ = 1.0;
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
  std::vector<std::uint32_t> first_;  // of each cell in items_, and one more
  std::vector<std::uint32_t> items_;  // boxes, cell by cell, ascending within a cell
};

}  // namespace ridgecraft
