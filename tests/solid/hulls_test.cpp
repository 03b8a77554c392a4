// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/hulls.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "segment/segment.hpp"
#include "solid/solid.hpp"
#include "solid/solid_checks.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

std::vector<Vec3> ball_points(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  while (points.size() < n) {
    const Vec3 p{2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0};
    if (length(p) <= 1.0 && length(p) > 0.1) {
      points.push_back(Vec3{3.0, 2.0, 1.0} + normalized(p));
    }
  }
  return points;
}

/// A table: a board and four legs, each of voxels.
mesh::Surface table() {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      cells.push_back({x, y, 3});
      if (x % 4 == 0 && y % 4 == 0) {
        for (int z = 0; z < 3; ++z) {
          cells.push_back({x, y, z});
        }
      }
    }
  }
  return test::voxels(cells, 1);
}

}  // namespace

TEST_CASE("Hulls enclose their parts whatever the limit of vertices") {
  const mesh::Surface surface = table();
  const auto parts = segment::segment(surface, {}, {.concavity = 0.1}, Context{});
  REQUIRE(parts.parts.size() == 5);
  for (const std::size_t limit : {0U, 8U, 16U, 64U}) {
    const auto bodies = solid::part_hulls(surface, parts, {.max_vertices = limit}, Context{});
    REQUIRE(bodies.size() == parts.parts.size());
    for (const PartId p : ids<PartId>(parts.parts.size())) {
      const solid::Body& body = bodies[p.value()];
      CHECK(test::closed_and_manifold(body));
      CHECK((limit == 0 || body.points.size() <= limit));
      std::vector<Vec3> points;
      for (const FaceId f : parts.parts[p].faces) {
        for (const VertexId v : surface.vertices(f)) {
          points.push_back(surface.point(v));
        }
      }
      CHECK(solid::encloses(body, points));
      CHECK(test::largest_excess(body, points) <= 1e-12);
    }
  }
}

TEST_CASE("Fewer vertices cost little volume and never a point") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto points = ball_points(2000, seed);
    const mesh::Surface sphere = test::sphere(40, 30);
    const auto parts = segment::segment(sphere, {}, {}, Context{});
    REQUIRE(parts.parts.size() == 1);
    double before = INFINITY;
    for (const std::size_t limit : {8U, 16U, 32U, 64U, 128U}) {
      const solid::Body body = solid::part_hulls(sphere, parts, {.max_vertices = limit}, Context{}).front();
      CHECK(body.points.size() <= limit);
      CHECK(solid::encloses(body, sphere.points()));
      const double volume = solid::mass_properties(body).volume;
      CHECK(volume <= before * (1.0 + 1e-9));
      before = volume;
    }
    // 128 corners: about 66 planes; the best such body round a ball has about 1.06 times its volume.
    CHECK(before < 1.10 * 4.0 / 3.0 * std::numbers::pi);
    const solid::Body hull = solid::convex_hull(points, 0.0);
    CHECK(solid::encloses(hull, points));
    CHECK(hull.points.size() == points.size());
  }
}

TEST_CASE("A hull is the same whatever order its points come in") {
  // Balls have triangles for sides; boxes have points within sides and edges.
  std::vector<Vec3> grid;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 3; ++y) {
      for (int z = 0; z <= 2; ++z) {
        grid.push_back({0.5 * x, 0.5 * y, 0.5 * z});
      }
    }
  }
  std::vector<Vec3> roof = grid;
  roof.push_back({1.0, 0.5, 2.5});
  for (std::vector<Vec3> points : {ball_points(500, 5), grid, roof}) {
    const solid::Body first = solid::convex_hull(points, 0.0);
    CHECK(test::closed_and_manifold(first));
    CHECK(solid::encloses(first, points));
    Random random(3);
    for (int turn = 0; turn < 20; ++turn) {
      for (std::uint32_t i = static_cast<std::uint32_t>(points.size()) - 1; i > 0; --i) {
        std::swap(points[i], points[random.below(i + 1)]);
      }
      const solid::Body again = solid::convex_hull(points, 0.0);
      REQUIRE(again.points == first.points);
      REQUIRE(again.triangles == first.triangles);
    }
  }
  CHECK(solid::convex_hull(grid, 0.0).points.size() == 8);
  CHECK(solid::convex_hull(grid, 0.0).triangles.size() == 12);
  CHECK(solid::convex_hull(roof, 0.0).points.size() == 9);
}

TEST_CASE("Few vertices suffice for a bar that lies askew") {
  const Vec3 along = normalized({1.0, 2.0, 3.0});
  const Vec3 across = normalized(cross(along, Vec3{0.0, 0.0, 1.0}));
  const Vec3 up = cross(along, across);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    const double turn = std::numbers::pi * i / 20.0;
    for (const double end : {-1.0, 1.0}) {
      points.push_back(end * along + 0.05 * std::cos(turn) * across + 0.05 * std::sin(turn) * up);
    }
  }
  const solid::Body hull = solid::convex_hull(points, 0.0);
  const double volume = solid::mass_properties(hull).volume;
  // A square round a circle has 1.27 times its area, a box along the axes hundreds of times.
  CHECK(solid::mass_properties(solid::enclosing_polytope(hull, 8, Context{})).volume < 1.30 * volume);
  CHECK(solid::mass_properties(solid::enclosing_polytope(hull, 16, Context{})).volume < 1.15 * volume);
}

TEST_CASE("Points without volume become thin bodies around them") {
  const std::vector<Vec3> one{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  const std::vector<Vec3> line{{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}};
  const std::vector<Vec3> square{{0.0, 0.0, 0.3}, {1.0, 0.0, 0.3}, {1.0, 1.0, 0.3}, {0.0, 1.0, 0.3}};
  for (const auto& points : {one, line, square}) {
    const solid::Body body = solid::convex_hull(points, 1e-4);
    CHECK(test::closed_and_manifold(body));
    CHECK(solid::encloses(body, points));
    CHECK(solid::mass_properties(body).volume > 0.0);
  }
}

TEST_CASE("Mass properties of a box") {
  const std::vector<Vec3> corners{{1, 1, 1}, {3, 1, 1}, {1, 5, 1}, {3, 5, 1},
                                  {1, 1, 7}, {3, 1, 7}, {1, 5, 7}, {3, 5, 7}};
  const auto mass = solid::mass_properties(solid::convex_hull(corners, 0.0));
  CHECK(mass.volume == Approx(48.0));
  CHECK(length(mass.center - Vec3{2.0, 3.0, 4.0}) < 1e-12);
  CHECK(mass.inertia[0] == Approx(48.0 / 12.0 * (16.0 + 36.0)));
  CHECK(mass.inertia[1] == Approx(48.0 / 12.0 * (4.0 + 36.0)));
  CHECK(mass.inertia[2] == Approx(48.0 / 12.0 * (4.0 + 16.0)));
  for (const std::size_t i : {3U, 4U, 5U}) {
    CHECK(mass.inertia[i] == Approx(0.0).margin(1e-9));
  }
}

TEST_CASE("OBJ of hulls has an object each and every bit") {
  const std::vector<Vec3> a{{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.0 / 3.0}};
  const std::vector<solid::Body> bodies{solid::convex_hull(a, 0.0), solid::convex_hull(a, 0.0)};
  const std::string text = solid::write_obj(bodies, "made by a test");
  CHECK(text.starts_with("# made by a test\no hull_1\nv "));
  CHECK(text.find("\no hull_2\nv ") != std::string::npos);
  CHECK(text.find("0.3333333333333333\n") != std::string::npos);
  CHECK(text.find("f 5 ") + text.find(" 8") > 0);
}

}  // namespace ridgecraft
