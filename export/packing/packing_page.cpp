// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_page.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace ridgecraft::paper {
namespace {

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

}  // namespace ridgecraft::paper
