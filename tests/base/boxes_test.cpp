// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of boxes find what looking at all boxes finds.
#include "base/boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"

using namespace ridgecraft;

namespace {

/// Points, `steps` places in each direction: a few make many of them equally near.
std::vector<Vec3> some_points(std::size_t count, std::uint32_t steps, Random& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({static_cast<double>(random.below(steps)), static_cast<double>(random.below(steps)),
                      static_cast<double>(random.below(steps))});
  }
  return points;
}

BoxTree<Box3> tree_of(const std::vector<Vec3>& points) {
  return {points.size(),
          [&](std::uint32_t i) {
            return Box3{points[i], points[i]};
          },
          [&](std::uint32_t i) { return points[i]; }};
}

struct Nearest {
  double distance = INFINITY;
  std::uint32_t place = 0;
};

Nearest nearest(const BoxTree<Box3>& tree, const std::vector<Vec3>& points, Vec3 from) {
  return tree.nearest_first(
      from, Nearest{},
      [](const Nearest& found, std::uint32_t, double distance) { return distance < found.distance; },
      [&](Nearest& found, std::uint32_t place) {
        const Vec3 way = points[tree.order()[place]] - from;
        if (dot(way, way) < found.distance) {
          found = {dot(way, way), place};
        }
      });
}

}  // namespace

TEST_CASE("a tree of boxes finds the nearest point, in lists of any size", "[base]") {
  Random random(1);
  for (const std::size_t count : {1U, 2U, 4U, 5U, 9U, 100U, 1000U}) {
    for (const std::uint32_t steps : {1U, 3U, 1000U}) {
      const std::vector<Vec3> points = some_points(count, steps, random);
      const BoxTree<Box3> tree = tree_of(points);
      std::vector<std::uint32_t> numbers = tree.order();
      std::sort(numbers.begin(), numbers.end());
      for (std::uint32_t i = 0; i < count; ++i) {
        CHECK(numbers[i] == i);
      }
      for (const Vec3 from : some_points(20, 2 * steps, random)) {
        double least = INFINITY;
        for (const Vec3 p : points) {
          least = std::min(least, dot(p - from, p - from));
        }
        CHECK(nearest(tree, points, from).distance == least);
      }
    }
  }
}

TEST_CASE("points at one place are ordered by their numbers, and the first of them is found", "[base]") {
  for (const std::size_t count : {3U, 8U, 500U}) {
    const std::vector<Vec3> points(count, Vec3{1.0, 2.0, 3.0});
    const BoxTree<Box3> tree = tree_of(points);
    CHECK(std::is_sorted(tree.order().begin(), tree.order().end()));
    CHECK(nearest(tree, points, {}).place == 0);
  }
}

TEST_CASE("a search through a tree of boxes visits what it lets in, in order, and nothing of the rest",
          "[base]") {
  Random random(3);
  for (const std::size_t count : {0U, 1U, 7U, 300U}) {
    std::vector<Box2> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 low{random.unit(), random.unit()};
      boxes.push_back({low, low + Vec2{0.1 * random.unit(), 0.1 * random.unit()}});
    }
    const BoxTree<Box2> tree(
        boxes.size(), [&](std::uint32_t i) { return boxes[i]; },
        [&](std::uint32_t i) { return 0.5 * (boxes[i].low + boxes[i].high); });
    const auto meets = [](const Box2& a, const Box2& b) {
      return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
    };
    for (const Box2& asked : boxes) {
      std::vector<std::uint32_t> visited;
      tree.search([&](std::uint32_t node) { return meets(tree.box(node), asked); },
                  [&](std::uint32_t place) { visited.push_back(place); });
      CHECK(std::is_sorted(visited.begin(), visited.end()));
      for (std::uint32_t place = 0; place < count; ++place) {
        if (meets(boxes[tree.order()[place]], asked)) {
          CHECK(std::binary_search(visited.begin(), visited.end(), place));
        }
      }
    }
  }
}

TEST_CASE("each node of a tree of boxes knows the largest value below it", "[base]") {
  Random random(4);
  const std::vector<Vec3> points = some_points(200, 50, random);
  const BoxTree<Box3> tree = tree_of(points);
  std::vector<double> value(points.size());
  for (double& v : value) {
    v = random.unit();
  }
  const std::vector<double> largest = tree.largest_below([&](std::uint32_t i) { return value[i]; });
  CHECK(largest[0] == *std::max_element(value.begin(), value.end()));
  // Only nodes that have a value above this are let in: all of those values are found.
  constexpr double least = 0.9;
  std::size_t found = 0;
  tree.search([&](std::uint32_t node) { return largest[node] > least; },
              [&](std::uint32_t place) { found += value[tree.order()[place]] > least ? 1U : 0U; });
  CHECK(found == static_cast<std::size_t>(
                     std::count_if(value.begin(), value.end(), [&](double v) { return v > least; })));
}
