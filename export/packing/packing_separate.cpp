// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_separate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/random.hpp"

namespace ridgecraft::paper {
namespace {

/// Weights of pairs, in units of 1 / first_weight; they stop growing at most_weight, so that sums over a row
/// of cells stay far below 2^31.
constexpr std::uint32_t first_weight = 64;
constexpr std::uint32_t most_weight = 1U << 16U;
/// Places looked at for each move, and how many of them are improved step by step.
constexpr int samples = 64;
constexpr std::size_t improved_samples = 3;
/// Runs of a shape that judge a sample; they are spread over its rows (Raster::solid).
constexpr std::size_t sample_runs = 24;
/// A search that comes near its end is given more time: overlap left, mm2, and how many times as much. What
/// is solved at all mostly is so early, and the last few cells take as long as all before.
struct Patience {
  double overlap_mm2;
  std::uint64_t times;
};
constexpr std::array<Patience, 2> more_patience{{{30.0, 8}, {300.0, 3}}};
/// First step of the improvement, cells; halved down to 1.
constexpr std::int32_t first_step = 8;

}  // namespace

PackingSeparation::PackingSeparation(const PackingFill& fill, Random& random, const Context& context)
    : fill_(fill),
      random_(random),
      context_(context),
      count_(fill.task().shapes.size()),
      weight_(count_ * count_, first_weight),
      overlap_(count_ * count_),
      padded_rows_(count_) {}

Spot PackingSeparation::last_spot(const Raster& raster) const {
  const PackingGrid& grid = fill_.grid();
  return {cells_of_room(grid.area.x, raster.size.x, grid.cell),
          cells_of_room(grid.area.y, raster.size.y, grid.cell)};
}

/// Sums up what all other shapes cover, each with its weight for this one.
void PackingSeparation::weigh(std::uint32_t shape, const std::vector<Place>& places) {
  const PackingGrid& grid = fill_.grid();
  const std::size_t stride = static_cast<std::size_t>(grid.columns) + 1;
  const std::size_t size = stride * static_cast<std::size_t>(grid.rows);
  for (std::vector<std::int32_t>& page : covered_) {
    page.assign(size, 0);
  }
  for (std::uint32_t other = 0; other < count_; ++other) {
    if (other == shape) {
      continue;
    }
    const Place& place = places[other];
    const auto weight = static_cast<std::int32_t>(weight_[shape * count_ + other]);
    std::vector<std::int32_t>& page = covered_[place.page];
    for (const Raster::Run& run : fill_.rasters(other)[place.turn].padded) {
      const std::int32_t y = run.row + place.spot.row;
      if (y >= 0 && y < grid.rows) {
        std::int32_t* row = page.data() + static_cast<std::size_t>(y) * stride;
        row[std::clamp(run.begin + place.spot.column, 0, grid.columns)] += weight;
        row[std::clamp(run.end + place.spot.column, 0, grid.columns)] -= weight;
      }
    }
  }
  for (std::vector<std::int32_t>& page : covered_) {
    for (std::size_t row = 0; row < page.size(); row += stride) {
      std::int32_t here = 0;
      std::int32_t sum = 0;
      for (std::size_t x = row; x < row + stride; ++x) {
        here += page[x];
        page[x] = sum;
        sum += here;
      }
    }
  }
  work_ += covered_.size() * size / 4;
}

std::int64_t PackingSeparation::cost(const Raster& raster, const Place& place, std::size_t runs,
                                     std::int64_t limit) {
  const PackingGrid& grid = fill_.grid();
  const std::size_t stride = static_cast<std::size_t>(grid.columns) + 1;
  const std::int32_t* page = covered_[place.page].data() + place.spot.column;
  std::int64_t sum = 0;
  runs = std::min(runs, raster.solid.size());
  for (std::size_t i = 0; i < runs && sum < limit; ++i) {
    const Raster::Run& run = raster.solid[i];
    const std::int32_t y = std::min(run.row + place.spot.row, grid.rows - 1);
    const std::int32_t* row = page + static_cast<std::size_t>(y) * stride;
    sum += row[std::min(run.end, grid.columns - place.spot.column)] - row[run.begin];
    ++work_;
  }
  return sum;
}

Place PackingSeparation::random_place(std::uint32_t shape, std::uint32_t pages) {
  const auto& rasters = fill_.rasters(shape);
  const std::uint32_t turn = random_.below(static_cast<std::uint32_t>(rasters.size()));
  const Spot last = last_spot(rasters[turn]);
  const auto below = [&](std::int32_t most) {
    return static_cast<std::int32_t>(random_.below(static_cast<std::uint32_t>(most) + 1));
  };
  return {random_.below(pages), turn, {below(last.column), below(last.row)}};
}

void PackingSeparation::improve(std::uint32_t shape, Candidate& candidate) {
  constexpr std::array<std::array<std::int32_t, 2>, 8> directions{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  const Raster& raster = fill_.rasters(shape)[candidate.place.turn];
  const Spot last = last_spot(raster);
  candidate.cost = cost(raster, candidate.place, raster.solid.size(), INT64_MAX);
  for (std::int32_t step = first_step; step >= 1 && candidate.cost > 0; step /= 2) {
    for (bool moved = true; moved && candidate.cost > 0;) {
      moved = false;
      const Spot from = candidate.place.spot;
      for (const auto& [right, up] : directions) {
        Place next = candidate.place;
        next.spot = {std::clamp(from.column + step * right, 0, last.column),
                     std::clamp(from.row + step * up, 0, last.row)};
        const std::int64_t there = cost(raster, next, raster.solid.size(), candidate.cost);
        if (there < candidate.cost) {
          candidate = {next, there};
          moved = true;
        }
      }
    }
  }
}

void PackingSeparation::relocate(std::uint32_t shape, std::vector<Place>& places, std::uint32_t pages) {
  weigh(shape, places);
  std::vector<Candidate> found;
  for (int i = 0; i < samples; ++i) {
    Candidate candidate{random_place(shape, pages)};
    candidate.cost =
        cost(fill_.rasters(shape)[candidate.place.turn], candidate.place, sample_runs, INT64_MAX);
    found.push_back(candidate);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  found.resize(improved_samples);
  Candidate best{places[shape]};
  improve(shape, best);
  for (Candidate& candidate : found) {
    improve(shape, candidate);
    if (candidate.cost < best.cost) {
      best = candidate;
    }
  }
  places[shape] = best.place;
}

const std::vector<std::uint32_t>& PackingSeparation::padded_rows(std::uint32_t shape, std::uint32_t turn) {
  const auto& rasters = fill_.rasters(shape);
  padded_rows_[shape].resize(rasters.size());
  std::vector<std::uint32_t>& rows = padded_rows_[shape][turn];
  if (rows.empty()) {
    const auto& padded = rasters[turn].padded;
    for (std::uint32_t i = 0; i < padded.size(); ++i) {
      while (rows.size() <= static_cast<std::size_t>(padded[i].row - padded.front().row)) {
        rows.push_back(i);
      }
    }
    rows.push_back(static_cast<std::uint32_t>(padded.size()));
  }
  return rows;
}

/// Cells that a touches and b keeps free.
std::uint32_t PackingSeparation::overlap(std::uint32_t a, std::uint32_t b, const std::vector<Place>& places) {
  if (places[a].page != places[b].page) {
    return 0;
  }
  const Raster& solid = fill_.rasters(a)[places[a].turn];
  const Raster& padded = fill_.rasters(b)[places[b].turn];
  const std::vector<std::uint32_t>& rows = padded_rows(b, places[b].turn);
  const std::int32_t up = places[a].spot.row - places[b].spot.row - padded.padded.front().row;
  const std::int32_t right = places[a].spot.column - places[b].spot.column;
  std::int32_t cells = 0;
  work_ += solid.solid.size();
  for (const Raster::Run& run : solid.solid) {
    const std::int32_t row = run.row + up;
    if (row < 0 || row + 1 >= static_cast<std::int32_t>(rows.size())) {
      continue;
    }
    for (std::uint32_t i = rows[static_cast<std::size_t>(row)]; i < rows[static_cast<std::size_t>(row) + 1];
         ++i) {
      const Raster::Run& other = padded.padded[i];
      cells += std::max(0, std::min(run.end + right, other.end) - std::max(run.begin + right, other.begin));
    }
  }
  return static_cast<std::uint32_t>(cells);
}

/// Overlaps of all pairs; whether there are none.
bool PackingSeparation::measure(const std::vector<Place>& places) {
  std::uint64_t sum = 0;
  for (std::uint32_t a = 0; a < count_; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const std::uint32_t cells = overlap(a, b, places);
      overlap_[a * count_ + b] = cells;
      overlap_[b * count_ + a] = cells;
      sum += cells;
    }
  }
  least_overlap_ = std::min(least_overlap_, sum);
  return sum == 0;
}

/// The worse the overlap, the more: up to twice. Pairs that are apart are slowly forgiven.
void PackingSeparation::raise_weights() {
  const std::uint32_t worst = *std::max_element(overlap_.begin(), overlap_.end());
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const std::uint64_t weight = weight_[i];
    weight_[i] = static_cast<std::uint32_t>(
        overlap_[i] > 0 ? std::min<std::uint64_t>(
                              most_weight, weight + weight / 5 + weight * overlap_[i] * 4 / (5 * worst))
                        : std::max<std::uint64_t>(first_weight, weight - weight / 16));
  }
}

std::uint64_t PackingSeparation::allowed(std::uint64_t most_work) const {
  const double left = static_cast<double>(least_overlap_) * fill_.grid().cell * fill_.grid().cell;
  for (const Patience& p : more_patience) {
    if (left <= p.overlap_mm2) {
      return p.times * most_work;
    }
  }
  return most_work;
}

bool PackingSeparation::run(std::vector<Place>& places, std::uint32_t pages, std::uint64_t most_work) {
  covered_.resize(pages);
  least_overlap_ = UINT64_MAX;
  const std::uint64_t begin = work_;
  std::vector<std::uint32_t> order(count_);
  bool apart = measure(places);
  while (!apart) {
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count_; i > 1; --i) {
      std::swap(order[i - 1], order[random_.below(static_cast<std::uint32_t>(i))]);
    }
    for (const std::uint32_t shape : order) {
      // Only those that are still in the way: an earlier move may have freed it.
      bool in_the_way = false;
      for (std::uint32_t other = 0; other < count_ && !in_the_way; ++other) {
        in_the_way = other != shape && overlap(shape, other, places) > 0;
      }
      if (in_the_way) {
        relocate(shape, places, pages);
      }
      context_.check();
      if (work_ - begin > allowed(most_work) || context_.out_of_time()) {
        return measure(places);
      }
    }
    apart = measure(places);
    raise_weights();
  }
  return true;
}

}  // namespace ridgecraft::paper
