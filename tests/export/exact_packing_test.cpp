// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes moved apart by their true outlines, and pages that are saved by it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "base/polygon.hpp"
#include "base/random.hpp"
#include "export/packing/packing.hpp"
#include "export/packing/packing_exact.hpp"
#include "export/packing/packing_tighter.hpp"
#include "export/packing_checks.hpp"

using namespace ridgecraft;
using namespace ridgecraft::paper;

namespace {

using Polygons = std::vector<std::vector<Vec2>>;

double area_of(const Polygons& polygons) {
  double sum = 0.0;
  for (const auto& polygon : polygons) {
    sum += 0.5 * std::abs(doubled_area(polygon));
  }
  return sum;
}

/// A star with so many points, as the triangles that it is made of.
Polygons star(std::size_t points, double outer, double inner) {
  Polygons triangles;
  std::vector<Vec2> rim;
  for (std::size_t i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
    const double radius = i % 2 == 0 ? outer : inner;
    rim.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    triangles.push_back({Vec2{}, rim[i], rim[(i + 1) % rim.size()]});
  }
  return triangles;
}

Polygons strips(std::size_t count, double width, double height) {
  Polygons polygons;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = width * static_cast<double>(i);
    polygons.push_back({{x, 0.0}, {x + width, 0.0}, {x + width, height}, {x, height}});
  }
  return polygons;
}

std::size_t page_count(const std::vector<Packed>& packed) {
  std::size_t pages = 0;
  for (const Packed& p : packed) {
    pages = std::max<std::size_t>(pages, p.page + 1);
  }
  return pages;
}

std::size_t faults(const PackingTask& task, const std::vector<Packed>& packed) {
  return test::packing_faults(
      task, static_cast<std::uint32_t>(page_count(packed)), [&](std::uint32_t i) { return packed[i].page; },
      [&](std::uint32_t i, Vec2 p) { return packed[i].turn(p) + packed[i].shift; });
}

}  // namespace

TEST_CASE("polygons that share sides become fewer convex ones on the same ground", "[exact_packing]") {
  CHECK(merged_convex(strips(7, 3.0, 10.0)).size() == 1);
  for (const std::size_t points : {3U, 5U, 12U}) {
    const Polygons before = star(points, 20.0, 8.0);
    const Polygons after = merged_convex(before);
    CHECK(after.size() < before.size());
    CHECK(area_of(after) == Approx(area_of(before)));
    for (const auto& polygon : after) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 one = polygon[(i + 1) % polygon.size()] - polygon[i];
        const Vec2 two = polygon[(i + 2) % polygon.size()] - polygon[(i + 1) % polygon.size()];
        CHECK(cross(one, two) >= -1e-9 * length(one) * length(two));
      }
    }
  }
}

TEST_CASE("shapes that fill a page to its borders are moved apart by their outlines", "[exact_packing]") {
  // Four triangles that make a rectangle in one way only, turned by quarters.
  PackingTask task;
  task.area = {100.0, 100.0};
  std::vector<std::vector<Turn>> turns;
  for (int i = 0; i < 4; ++i) {
    task.shapes.push_back(packing_shape({{{0.0, 0.0}, {99.9, 0.0}, {49.95, 49.95}}}));
    task.group.push_back(0);
    turns.push_back({{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}});
  }
  const Context context;
  Random random(1);
  ExactSeparation separation(task, turns, random, context);
  std::vector<ExactPlace> places(4);
  REQUIRE(separation.run(places, 1, task.area, 50'000'000));
  std::vector<Packed> packed;
  for (std::uint32_t i = 0; i < 4; ++i) {
    packed.push_back(
        {places[i].page, turns[i][places[i].turn], places[i].at - separation.low(i, places[i].turn)});
  }
  CHECK(faults(task, packed) == 0);
}

TEST_CASE("what the exact search says is apart keeps the gap, and what has no room isn't",
          "[exact_packing]") {
  Random shapes(5);
  for (const double gap : {0.0, 2.0}) {
    PackingTask task;
    task.area = {190.0, 265.0};
    task.gap = gap;
    std::vector<std::vector<Turn>> turns;
    for (int i = 0; i < 14; ++i) {
      const double size = 12.0 + 22.0 * shapes.unit();
      task.shapes.push_back(
          packing_shape(star(3 + shapes.below(5), size, (0.3 + 0.5 * shapes.unit()) * size)));
      task.group.push_back(0);
      turns.push_back(promising_turns(task.shapes.back().hull, task.area, 6));
    }
    const Context context;
    Random random(2);
    ExactSeparation separation(task, turns, random, context);
    std::vector<ExactPlace> places(task.shapes.size());
    REQUIRE(separation.run(places, 1, task.area, 200'000'000));
    std::vector<Packed> packed;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      packed.push_back(
          {places[i].page, turns[i][places[i].turn], places[i].at - separation.low(i, places[i].turn)});
    }
    CHECK(faults(task, packed) == 0);
    CHECK_FALSE(separation.run(places, 1, {60.0, 80.0}, 2'000'000));
    CHECK(separation.left() > 0.0);
  }
}

TEST_CASE("longer packing saves pages and keeps what packing promises", "[exact_packing]") {
  // Wedges that fill more and more of two pages, up to where bitmaps have no room for them.
  const Context context;
  bool tried = false;
  bool saved = false;
  for (const double share : {0.70, 0.73, 0.76}) {
    PackingTask task;
    task.area = {190.0, 265.0};
    task.gap = 1.0;
    Random shapes(11);
    double area = 0.0;
    while (area < share * 2.0 * task.area.x * task.area.y) {
      const double wide = 35.0 + 45.0 * shapes.unit();
      const double high = 40.0 + 60.0 * shapes.unit();
      task.shapes.push_back(
          packing_shape({{{0.0, 0.0}, {wide, 0.0}, {0.3 * wide, high}, {0.0, 0.7 * high}}}));
      task.group.push_back(0);
      area += task.shapes.back().area;
    }
    const std::vector<Packed> before = pack(task, context);
    std::vector<Packed> after = before;
    CHECK_FALSE(pack_tighter(task, 0, context, after));
    tried = tried || page_count(before) > 2;
    const std::uint64_t work = 60'000'000;
    const bool fewer = pack_tighter(task, work, context, after);
    CHECK(fewer == (page_count(after) < page_count(before)));
    CHECK(faults(task, after) == 0);
    std::vector<Packed> again = before;
    CHECK(pack_tighter(task, work, context, again) == fewer);
    for (std::size_t i = 0; i < after.size(); ++i) {
      CHECK((after[i].page == again[i].page && after[i].shift == again[i].shift));
    }
    saved = saved || fewer;
    UNSCOPED_INFO(share << ": " << page_count(before) << " pages before, " << page_count(after) << " after");
  }
  CHECK(tried);
  CHECK(saved);
}
