// SPDX-License-Identifier: GPL-3.0-or-later
// Packing as a whole: the search over orders, from several pages down to few.
#include "export/packing/packing.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "export/packing_checks.hpp"

using namespace ridgecraft;
using namespace ridgecraft::export_;

namespace {

/// Corners and rings of thin bars: little paper, but each takes a large part of a page.
PackingTask bars(std::uint64_t seed, std::uint32_t count) {
  PackingTask task;
  task.area = {190.0, 265.0};
  task.gap = 2.0;
  Random random(seed);
  const auto bar = [](double x, double y, double width, double height) {
    return std::vector<Vec2>{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const double width = 50.0 + 120.0 * random.unit();
    const double height = 50.0 + 120.0 * random.unit();
    constexpr double thin = 6.0;
    std::vector<std::vector<Vec2>> shape{bar(0.0, 0.0, width, thin), bar(0.0, 0.0, thin, height)};
    if (random.below(2) == 0) {
      shape.push_back(bar(0.0, height - thin, width, thin));
      shape.push_back(bar(width - thin, 0.0, thin, height));
    }
    task.shapes.push_back(packing_shape(std::move(shape)));
    task.group.push_back(i / 3);
  }
  return task;
}

std::uint32_t page_count(const std::vector<Packed>& packed) {
  std::uint32_t pages = 0;
  for (const Packed& place : packed) {
    pages = std::max(pages, place.page + 1);
  }
  return pages;
}

std::size_t faults(const PackingTask& task, const std::vector<Packed>& packed, std::uint32_t pages) {
  return test::packing_faults(
      task, pages, [&](std::uint32_t i) { return packed[i].page; },
      [&](std::uint32_t i, Vec2 p) { return packed[i].turn(p) + packed[i].shift; });
}

}  // namespace

TEST_CASE("the search goes on where it comes from three pages to two", "[packing]") {
  std::size_t two = 0;
  for (std::uint64_t seed = 85; seed < 100; ++seed) {
    CAPTURE(seed);
    const PackingTask task = bars(seed, 4 + static_cast<std::uint32_t>(seed % 9));
    const std::vector<Packed> packed = pack(task, Context{});
    REQUIRE(packed.size() == task.shapes.size());
    const std::uint32_t pages = page_count(packed);
    two += pages == 2 ? 1U : 0U;
    CHECK(faults(task, packed, pages) == 0);
  }
  CHECK(two > 0);
}

TEST_CASE("a longer search needs no more pages, fewer at times, and is the same each time", "[packing]") {
  bool fewer = false;
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    CAPTURE(seed);
    PackingTask task = bars(seed, 12);
    task.search_work = 1;
    const std::uint32_t pages = page_count(pack(task, Context{}));
    task.search_work = long_search_work;
    const std::vector<Packed> packed = pack(task, Context{});
    CHECK(page_count(packed) <= pages);
    CHECK(faults(task, packed, page_count(packed)) == 0);
    const std::vector<Packed> again = pack(task, Context{});
    for (std::size_t i = 0; i < packed.size(); ++i) {
      CHECK((packed[i].page == again[i].page && packed[i].shift == again[i].shift));
    }
    fewer = fewer || page_count(packed) < pages;
  }
  CHECK(fewer);
}
