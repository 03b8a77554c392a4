// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/polygon.hpp"

namespace ridgecraft::paper {
namespace {

/// A cell that a piece only touches within rounding isn't covered, mm. The gap has room for it.
constexpr double touch = 1e-7;

using Run = Raster::Run;

/// Rounded down; for numbers far above -4096 and far below 2^31, as cells of a page are.
std::int32_t rounded_down(double x) {
  constexpr std::int32_t offset = 4096;
  return static_cast<std::int32_t>(x + offset) - offset;
}

/// Leftmost and rightmost x of a convex polygon, grown by a gap all round, in each row of cells.
class Reaches {
 public:
  Reaches(double cell, double gap) : cell_(cell), per_mm_(1.0 / cell), gap_(gap) {}

  void measure(std::span<const Vec2> polygon) {
    double low = INFINITY;
    double high = -INFINITY;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      low = std::min(low, polygon[i].y - gap_);
      high = std::max(high, polygon[i].y + gap_);
    }
    const bool counterclockwise = doubled_area(polygon) > 0.0;
    first_ = row_of(low + touch);
    last_ = std::max(first_, row_of(high - touch));
    reach_.assign(static_cast<std::size_t>(last_ - first_) + 1, {});
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 p = polygon[i];
      const Vec2 q = polygon[(i + 1) % polygon.size()];
      const double size = length(q - p);
      if (gap_ == 0.0 || size == 0.0) {
        add_line(p, q);
      } else {
        const Vec2 out = (counterclockwise ? -gap_ : gap_) / size * perpendicular(q - p);
        add_line(p + out, q + out);
      }
      if (gap_ > 0.0) {
        add_disk(p);
      }
    }
  }
  /// Calls visit(row, first cell, cell behind the last one).
  template <class Visit>
  void visit(Visit visit) const {
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      if (reach_[i].low <= reach_[i].high) {
        const std::int32_t begin = row_of(reach_[i].low + touch);
        visit(first_ + static_cast<std::int32_t>(i), begin,
              std::max(begin, row_of(reach_[i].high - touch)) + 1);
      }
    }
  }

 private:
  struct Reach {
    double low = INFINITY;
    double high = -INFINITY;
  };
  [[nodiscard]] std::int32_t row_of(double y) const { return rounded_down(y * per_mm_); }
  void add(std::int32_t row, double x) {
    Reach& reach = reach_[static_cast<std::size_t>(row - first_)];
    reach.low = std::min(reach.low, x);
    reach.high = std::max(reach.high, x);
  }
  void add_line(Vec2 p, Vec2 q) {
    if (p.y > q.y) {
      std::swap(p, q);
    }
    const std::int32_t from = std::clamp(row_of(p.y), first_, last_);
    const std::int32_t to = std::clamp(row_of(q.y), first_, last_);
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0.0;
    double x = p.x;
    for (std::int32_t row = from; row < to; ++row) {
      add(row, x);
      x = p.x + ((row + 1) * cell_ - p.y) * slope;
      add(row, x);
    }
    add(to, x);
    add(to, q.x);
  }
  void add_disk(Vec2 p) {
    const std::int32_t to = std::min(last_, row_of(p.y + gap_));
    for (std::int32_t row = std::max(first_, row_of(p.y - gap_)); row <= to; ++row) {
      const double away = std::max({0.0, row * cell_ - p.y, p.y - (row + 1) * cell_});
      const double wide = std::sqrt(std::max(0.0, gap_ * gap_ - away * away));
      add(row, p.x - wide);
      add(row, p.x + wide);
    }
  }

  double cell_;
  double per_mm_;
  double gap_;
  std::int32_t first_ = 0;
  std::int32_t last_ = 0;
  std::vector<Reach> reach_;
};

/// Cells as bits, row by row; unites what polygons cover.
class CellSet {
 public:
  /// For cells from -border to size + border.
  CellSet(Vec2 size_in_cells, std::int32_t border)
      : border_(border),
        words_((static_cast<std::size_t>(size_in_cells.x) + 2 * static_cast<std::size_t>(border)) / 64 + 1),
        rows_(static_cast<std::size_t>(size_in_cells.y) + 2 * static_cast<std::size_t>(border) + 1),
        bits_(words_ * rows_) {}

  void add(std::int32_t row, std::int32_t begin, std::int32_t end) {
    std::uint64_t* bits = bits_.data() + static_cast<std::size_t>(row + border_) * words_;
    const auto from = static_cast<std::size_t>(begin + border_);
    const auto last = static_cast<std::size_t>(end + border_ - 1);
    const std::uint64_t head = ~std::uint64_t{0} << (from % 64);
    const std::uint64_t tail = ~std::uint64_t{0} >> (63 - last % 64);
    if (from / 64 == last / 64) {
      bits[from / 64] |= head & tail;
      return;
    }
    bits[from / 64] |= head;
    for (std::size_t word = from / 64 + 1; word < last / 64; ++word) {
      bits[word] = ~std::uint64_t{0};
    }
    bits[last / 64] |= tail;
  }
  [[nodiscard]] std::vector<Run> runs() const {
    std::vector<Run> runs;
    for (std::size_t row = 0; row < rows_; ++row) {
      const std::uint64_t* bits = bits_.data() + row * words_;
      for (std::size_t at = next(bits, 0, 0); at < 64 * words_;) {
        const std::size_t end = next(bits, at, ~std::uint64_t{0});
        runs.push_back({static_cast<std::int32_t>(row) - border_, static_cast<std::int32_t>(at) - border_,
                        static_cast<std::int32_t>(end) - border_});
        at = next(bits, end, 0);
      }
    }
    return runs;
  }

 private:
  /// The next bit that is set; with all bits flipped, the next one that isn't.
  std::size_t next(const std::uint64_t* bits, std::size_t at, std::uint64_t flip) const {
    for (std::size_t word = at / 64; word < words_; ++word, at = 64 * word) {
      const std::uint64_t rest = (bits[word] ^ flip) & (~std::uint64_t{0} << (at % 64));
      if (rest != 0) {
        return 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
      }
    }
    return 64 * words_;
  }

  std::int32_t border_;
  std::size_t words_;
  std::size_t rows_;
  std::vector<std::uint64_t> bits_;
};

/// In the order of halving: the longest run, then ever finer steps over the rows, so that the first few say
/// most.
void spread(std::vector<Run>& runs) {
  const auto longest = std::max_element(
      runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.end - a.begin < b.end - b.begin; });
  std::vector<Run> result{*longest};
  runs.erase(longest);
  for (std::size_t step = std::bit_ceil(runs.size() + 1); step >= 2; step /= 2) {
    for (std::size_t i = step / 2; i <= runs.size(); i += step) {
      result.push_back(runs[i - 1]);
    }
  }
  runs = std::move(result);
}

}  // namespace

Raster rasterize(const PackingShape& shape, Turn turn, double cell, double gap) {
  Raster raster;
  raster.turn = turn;
  Box2 box;
  for (const Vec2 p : shape.hull) {
    box.add(turn(p));
  }
  raster.low = box.low;
  raster.size = box.size();
  const Vec2 cells = (1.0 / cell) * raster.size;
  const auto border = static_cast<std::int32_t>(gap / cell) + 2;
  Reaches solid_reach(cell, 0.0);
  Reaches padded_reach(cell, gap);
  CellSet solid(cells, border);
  CellSet padded(cells, border);
  std::vector<Vec2> turned;
  for (const auto& polygon : shape.convex) {
    turned.clear();
    for (const Vec2 p : polygon) {
      turned.push_back(turn(p) - box.low);
    }
    solid_reach.measure(turned);
    solid_reach.visit([&](auto row, auto begin, auto end) { solid.add(row, begin, end); });
    padded_reach.measure(turned);
    padded_reach.visit([&](auto row, auto begin, auto end) { padded.add(row, begin, end); });
  }
  raster.solid = solid.runs();
  raster.padded = padded.runs();
  spread(raster.solid);
  return raster;
}

}  // namespace ridgecraft::paper
