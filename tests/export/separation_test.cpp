// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes moved apart: what can be is, what can't be isn't, and no two come nearer than the gap.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "export/packing/packing_separate.hpp"
#include "export/packing_checks.hpp"

using namespace ridgecraft;
using namespace ridgecraft::paper;

namespace {

PackingTask box_task(const std::vector<Vec2>& sizes) {
  PackingTask task;
  task.area = {190.0, 265.0};
  task.gap = 2.0;
  for (const Vec2 size : sizes) {
    task.shapes.push_back(packing_shape({{{0.0, 0.0}, {size.x, 0.0}, size, {0.0, size.y}}}));
    task.group.push_back(0);
  }
  return task;
}

std::size_t faults(const PackingTask& task, const PackingFill& fill, const std::vector<Place>& places,
                   std::uint32_t pages) {
  return test::packing_faults(
      task, pages, [&](std::uint32_t i) { return places[i].page; },
      [&](std::uint32_t i, Vec2 p) {
        const Raster& raster = fill.rasters(i)[places[i].turn];
        return raster.turn(p) - raster.low + fill.corner(places[i].spot);
      });
}

}  // namespace

TEST_CASE("shapes piled up in a corner are moved apart", "[separation]") {
  // Six and four boxes fill two pages to two thirds: they have to be shared out.
  std::vector<Vec2> sizes(6, Vec2{80.0, 75.0});
  sizes.insert(sizes.end(), 4, Vec2{80.0, 90.0});
  const PackingTask task = box_task(sizes);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    const Context context;
    PackingFill fill(task, {}, context);
    Random random(seed);
    std::vector<Place> places(task.shapes.size(), Place{0, 0, {}});
    PackingSeparation separation(fill, random, context);
    CHECK(separation.run(places, 2, 40'000'000));
    CHECK(faults(task, fill, places, 2) == 0);
  }
}

TEST_CASE("what has no room isn't said to have any", "[separation]") {
  // Any two of them fill more than a page's width and height.
  const PackingTask task = box_task({{100.0, 140.0}, {100.0, 140.0}, {140.0, 100.0}, {120.0, 140.0}});
  const Context context;
  PackingFill fill(task, {}, context);
  Random random(1);
  std::vector<Place> places(task.shapes.size(), Place{0, 0, {}});
  PackingSeparation separation(fill, random, context);
  CHECK_FALSE(separation.run(places, 1, 1'000'000));
  CHECK(faults(task, fill, places, 1) > 0);
}
