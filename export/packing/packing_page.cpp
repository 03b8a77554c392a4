// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_page.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {
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

/// Grids have at most this many columns (PackingGrid makes cells larger on larger sheets).
constexpr std::size_t most_words = 16;

/// A row of the grid. The number of words is fixed at compile time: shifting is all that the search does.
template <std::size_t N>
using Words = std::array<std::uint64_t, N>;

/// The bits moved down by so many places; above them 0.
template <std::size_t N>
Words<N> shifted_down(const Words<N>& bits, std::uint32_t by) {
  std::array<std::uint64_t, 2 * N + 1> wide{};
  std::copy_n(bits.begin(), N, wide.begin());
  const std::uint64_t* from = wide.data() + std::min<std::size_t>(by / 64, N);
  const std::uint32_t rest = by % 64;
  Words<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    // Two steps, since a shift by 64 isn't defined.
    result[i] = (from[i] >> rest) | ((from[i + 1] << 1U) << (63U - rest));
  }
  return result;
}

/// The first or the last column that isn't blocked; there is one.
template <std::size_t N>
std::int32_t free_column(const Words<N>& blocked, bool leftmost) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t word = leftmost ? i : N - 1 - i;
    if (const std::uint64_t free = ~blocked[word]; free != 0) {
      return static_cast<std::int32_t>(64 * word) +
             (leftmost ? std::countr_zero(free) : 63 - std::countl_zero(free));
    }
  }
  return 0;
}

/// Columns beyond `last`, where the piece would stick out.
template <std::size_t N>
Words<N> columns_beyond(std::int32_t last) {
  Words<N> outside;
  for (std::size_t i = 0; i < N; ++i) {
    const std::int32_t inside = std::clamp(last + 1 - static_cast<std::int32_t>(64 * i), 0, 64);
    outside[i] = inside == 64 ? 0 : ~std::uint64_t{0} << static_cast<unsigned>(inside);
  }
  return outside;
}

/// The rows of one page with their levels; a row's levels are behind each other, and N + 1 words may be read
/// behind the last one.
struct RowTable {
  const std::uint64_t* bits;
  std::size_t levels;
};

/// Adds the columns at which the run meets a taken cell of the row; true when none is left. Columns where the
/// run would stick out get whatever stands behind the row: they are blocked anyway.
template <std::size_t N>
bool block(Words<N>& blocked, const RowTable& table, std::int32_t row, const Raster::Run& run) {
  const auto count = static_cast<std::uint32_t>(run.end - run.begin);
  const auto level = static_cast<std::size_t>(std::bit_width(count)) - 1;
  const std::uint64_t* bits = table.bits + (static_cast<std::size_t>(row) * table.levels + level) * N;
  const auto begin = static_cast<std::uint32_t>(run.begin);
  const std::uint32_t second = begin + count - (1U << level);
  const std::uint64_t* front = bits + begin / 64;
  const std::uint64_t* back = bits + second / 64;
  const std::uint32_t front_rest = begin % 64;
  const std::uint32_t back_rest = second % 64;
  std::uint64_t all = ~std::uint64_t{0};
  for (std::size_t i = 0; i < N; ++i) {
    // Two steps, since a shift by 64 isn't defined.
    blocked[i] |= (front[i] >> front_rest) | ((front[i + 1] << 1U) << (63U - front_rest)) |
                  (back[i] >> back_rest) | ((back[i + 1] << 1U) << (63U - back_rest));
    all &= blocked[i];
  }
  return all == ~std::uint64_t{0};
}

template <std::size_t N>
std::optional<Spot> lowest_spot(const PackingGrid& grid, const RowTable& table, const Raster& raster,
                                std::int32_t up, bool leftmost, std::uint64_t& work) {
  const Words<N> outside = columns_beyond<N>(cells_of_room(grid.area.x, raster.size.x, grid.cell));
  for (std::int32_t y = 0; y <= up; ++y) {
    Words<N> blocked = outside;
    bool full = false;
    for (const Raster::Run& run : raster.solid) {
      const std::int32_t row = run.row + y;
      if (row >= grid.rows) {
        continue;  // rounding: the last cell may be touched by less than the fit tolerance
      }
      work += N;
      full = block<N>(blocked, table, row, run);
      if (full) {
        break;
      }
    }
    if (!full) {
      return Spot{free_column<N>(blocked, leftmost), y};
    }
  }
  return std::nullopt;
}

/// Sets the levels of a row from its first.
template <std::size_t N>
void update_row(std::uint64_t* bits, std::size_t levels) {
  for (std::size_t level = 1; level < levels; ++level, bits += N) {
    Words<N> half;
    std::copy_n(bits, N, half.begin());
    const Words<N> moved = shifted_down<N>(half, 1U << (level - 1));
    for (std::size_t i = 0; i < N; ++i) {
      bits[N + i] = half[i] | moved[i];
    }
  }
}

/// Calls `work` with the number of words of a row as a compile-time constant.
template <class Work>
auto with_words(std::size_t words, Work work) {
  switch (words) {
    case 1:
      return work.template operator()<1>();
    case 2:
      return work.template operator()<2>();
    case 3:
      return work.template operator()<3>();
    case 4:
      return work.template operator()<4>();
    case 5:
      return work.template operator()<5>();
    case 6:
      return work.template operator()<6>();
    case 8:
      return work.template operator()<8>();
    default:
      return work.template operator()<most_words>();
  }
}

/// Fewest words of those compiled that hold so many columns.
std::size_t words_for(std::int32_t columns) {
  const std::size_t needed = (static_cast<std::size_t>(columns) + 63) / 64;
  return needed <= 6 ? needed : needed <= 8 ? 8 : most_words;
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

PackingGrid::PackingGrid(Vec2 area_mm, double cell_mm)
    : area(area_mm), cell(std::max(cell_mm, area_mm.x / (64.0 * most_words - 2.0))) {
  columns = static_cast<std::int32_t>(std::ceil(area.x / cell)) + 1;
  rows = static_cast<std::int32_t>(std::ceil(area.y / cell)) + 1;
  words = words_for(columns);
}

std::int32_t cells_of_room(double side, double size, double cell) {
  return static_cast<std::int32_t>(std::floor(std::max(0.0, side - size) / cell + 1e-9));
}

PackingPage::PackingPage(const PackingGrid& grid)
    : grid_(&grid),
      levels_(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(grid.columns)))),
      // Behind the last row there is room for block() to read.
      meets_(grid.words * levels_ * static_cast<std::size_t>(grid.rows) + 2 * grid.words + 1) {}

std::optional<Spot> PackingPage::find(const Raster& raster, double limit, bool leftmost,
                                      std::uint64_t& work) const {
  if (raster.size.y > limit) {
    return std::nullopt;
  }
  const std::int32_t up = cells_of_room(std::min(limit, grid_->area.y), raster.size.y, grid_->cell);
  return with_words(grid_->words, [&]<std::size_t N>() {
    return lowest_spot<N>(*grid_, {meets_.data(), levels_}, raster, up, leftmost, work);
  });
}

void PackingPage::take(const Raster& raster, Spot spot) {
  const auto update = [&](std::int32_t y) {
    std::uint64_t* bits = meets_.data() + static_cast<std::size_t>(y) * levels_ * grid_->words;
    with_words(grid_->words, [&]<std::size_t N>() { update_row<N>(bits, levels_); });
  };
  std::int32_t changed = -1;  // the runs are sorted by rows: each row's levels are set once
  for (const Raster::Run& run : raster.padded) {
    const std::int32_t y = run.row + spot.row;
    if (y < 0 || y >= grid_->rows) {
      continue;
    }
    if (y != changed && changed >= 0) {
      update(changed);
    }
    changed = y;
    std::uint64_t* bits = meets_.data() + static_cast<std::size_t>(y) * levels_ * grid_->words;
    const std::int32_t begin = std::max(0, run.begin + spot.column);
    const std::int32_t end = std::min(grid_->columns, run.end + spot.column);
    for (std::int32_t x = begin; x < end;) {
      const std::int32_t stop = std::min(end, (x / 64 + 1) * 64);
      const std::uint64_t ones =
          stop - x == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << static_cast<unsigned>(stop - x)) - 1;
      bits[x / 64] |= ones << static_cast<unsigned>(x % 64);
      x = stop;
    }
  }
  if (changed >= 0) {
    update(changed);
  }
}

}  // namespace ridgecraft::export_
