// SPDX-License-Identifier: GPL-3.0-or-later
// Points found by place: cubic cells in a sorted list. Private to mesh/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/vector.hpp"

namespace ridgecraft::mesh {

class PointCells {
 public:
  /// `numbers` are indices into points; cells are `size` wide.
  PointCells(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& numbers, double size)
      : size_(size) {
    entries_.reserve(numbers.size());
    for (const std::uint32_t i : numbers) {
      entries_.push_back({cell(points[i]), i});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls visit(number) for all points in the cell of p and the 26 around it; among them are all within
  /// `size` of p.
  template <class Visit>
  void near(Vec3 p, Visit visit) const {
    const Cell middle = cell(p);
    for (double x = -1.0; x <= 1.0; x += 1.0) {
      for (double y = -1.0; y <= 1.0; y += 1.0) {
        // The three cells of a column stand together.
        const Entry low{{middle[0] + x, middle[1] + y, middle[2] - 1.0}, 0};
        const Cell high{middle[0] + x, middle[1] + y, middle[2] + 1.0};
        for (auto it = std::lower_bound(entries_.begin(), entries_.end(), low);
             it != entries_.end() && it->cell <= high; ++it) {
          visit(it->number);
        }
      }
    }
  }

 private:
  // Whole numbers as doubles: they don't overflow.
  using Cell = std::array<double, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t number;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  [[nodiscard]] Cell cell(Vec3 p) const {
    return {std::floor(p.x / size_), std::floor(p.y / size_), std::floor(p.z / size_)};
  }
  double size_;
  std::vector<Entry> entries_;
};

}  // namespace ridgecraft::mesh
