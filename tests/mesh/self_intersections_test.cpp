// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that run through each other, and the boxes by which near pairs are found, against all pairs.
#include "mesh/repair/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/near_boxes.hpp"
#include "base/random.hpp"

namespace ridgecraft::mesh {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs found_pairs(const std::vector<Box3>& boxes) {
  Pairs pairs;
  NearBoxes(boxes).for_pairs(
      [&](std::uint32_t i, std::uint32_t j) { pairs.emplace_back(std::min(i, j), std::max(i, j)); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs touching_pairs(const std::vector<Box3>& boxes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const Box3& a = boxes[i];
      const Box3& b = boxes[j];
      if (a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
          a.low.z <= b.high.z && b.low.z <= a.high.z) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

/// Boxes of many sizes, on a coarse grid so that many touch exactly.
std::vector<Box3> some_boxes(std::uint64_t seed, std::size_t count, double grid, Vec3 far_off) {
  Random random(seed);
  const auto coordinate = [&](double size) { return std::floor(random.unit() * size) * grid; };
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    const double extent = random.below(20) == 0 ? 40.0 : 3.0;
    const Vec3 low = far_off + Vec3{coordinate(100.0), coordinate(100.0), coordinate(100.0)};
    box.add(low);
    box.add(low + Vec3{coordinate(extent), coordinate(extent), coordinate(extent)});
  }
  return boxes;
}

/// Two tetrahedra, the second moved.
Surface two_tetrahedra(Vec3 by) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Vec3 move : {Vec3{}, by}) {
    const auto n = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      points.push_back(p + move);
    }
    for (const auto& [a, b, c] :
         {std::array{0U, 2U, 1U}, std::array{0U, 1U, 3U}, std::array{1U, 2U, 3U}, std::array{2U, 0U, 3U}}) {
      faces.push_back({VertexId(n + a), VertexId(n + b), VertexId(n + c)});
    }
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("all pairs of boxes that touch are found, each once", "[mesh]") {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 9U, 300U}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const std::vector<Box3> boxes = some_boxes(seed, count, 0.125, {});
      CHECK(found_pairs(boxes) == touching_pairs(boxes));
    }
  }
}

TEST_CASE("no pair of boxes is lost to single precision", "[mesh]") {
  const std::vector<Box3> boxes = some_boxes(7, 300, 0.1, {1e9, -3e7, 12.3});
  const Pairs found = found_pairs(boxes);
  const Pairs touching = touching_pairs(boxes);
  CHECK(std::includes(found.begin(), found.end(), touching.begin(), touching.end()));
  CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
}

TEST_CASE("faces that run through each other are counted", "[mesh]") {
  CHECK(count_self_intersections(two_tetrahedra({2.0, 0.0, 0.0}), {}) == 0);
  // Along the diagonal: the slanted face of the first one runs through the three others of the second.
  CHECK(count_self_intersections(two_tetrahedra({0.2, 0.2, 0.2}), {}) == 3);
  // They touch at one corner only, which is a corner of both.
  CHECK(count_self_intersections(two_tetrahedra({1.0, 0.0, 0.0}), {}) == 0);
  // A corner of one lies within a face of the other.
  CHECK(count_self_intersections(two_tetrahedra({0.25, 0.25, 0.5}), {}) > 0);
}

TEST_CASE("counting faces that run through each other can be stopped", "[mesh]") {
  // Large triangles anywhere: most pairs of them meet.
  Random random(3);
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (std::uint32_t f = 0; f < 1000; ++f) {
    for (int k = 0; k < 3; ++k) {
      points.push_back({random.unit(), random.unit(), random.unit()});
    }
    faces.push_back({VertexId(3 * f), VertexId(3 * f + 1), VertexId(3 * f + 2)});
  }
  StopSource stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  CHECK_THROWS_AS(count_self_intersections(Surface(std::move(points), std::move(faces)), context), Error);
}

}  // namespace ridgecraft::mesh
