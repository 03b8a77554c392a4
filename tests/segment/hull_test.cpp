// SPDX-License-Identifier: GPL-3.0-or-later
// Exact hulls, and the nearest of their planes.
#include "segment/hull/hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/hull/hull_depth.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft {
namespace {

using segment::Hull;

Hull hull_of(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& order) {
  segment::HullBuilder builder(points);
  Hull hull;
  builder.build(order, hull);
  return hull;
}

Hull hull_of(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  return hull_of(points, order);
}

std::set<std::array<std::uint32_t, 3>> triangles_of(const Hull& hull) {
  std::set<std::array<std::uint32_t, 3>> all;
  for (auto t : hull.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.insert(t);
  }
  return all;
}

/// All points on or below all facets, exactly; a closed surface; Euler's formula; flat faces are fans.
void check_hull(const std::vector<Vec3>& points, const Hull& hull) {
  REQUIRE_FALSE(hull.flat);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : hull.triangles) {
    CHECK_FALSE(segment::exactly_collinear(points[t[0]], points[t[1]], points[t[2]]));
    for (const Vec3 p : points) {
      if (segment::exact_orientation(points[t[0]], points[t[1]], points[t[2]], p) > 0) {
        FAIL("a point lies above a facet");
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      ++sides[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [side, count] : sides) {
    CHECK(count == 1);
    CHECK(sides.count({side.second, side.first}) == 1);
  }
  CHECK(hull.vertices.size() + hull.triangles.size() == hull.edges.size() + 2);
  CHECK(2 * hull.edges.size() == 3 * hull.triangles.size());
  CHECK(std::is_sorted(hull.vertices.begin(), hull.vertices.end()));
  CHECK(std::is_sorted(hull.edges.begin(), hull.edges.end()));
  for (std::size_t e = 0; e < hull.edges.size(); ++e) {
    for (const std::uint32_t t : hull.edge_triangles[e]) {
      CHECK(std::count(hull.triangle_edges[t].begin(), hull.triangle_edges[t].end(), e) == 1);
    }
  }
}

/// The same hull whatever the order, and from the hull vertices alone.
void check_canonical(const std::vector<Vec3>& points, const Hull& hull) {
  Random random(5);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    }
    CHECK(triangles_of(hull_of(points, order)) == triangles_of(hull));
  }
  const Hull again = hull_of(points, hull.vertices);
  CHECK(triangles_of(again) == triangles_of(hull));
  CHECK(again.edges == hull.edges);
}

std::vector<Vec3> snapped(std::vector<Vec3> points) {
  for (Vec3& p : points) {
    p = segment::snap_to_grid(p);
  }
  return points;
}

}  // namespace

TEST_CASE("Hulls of random points hold them all, exactly") {
  Random random(1);
  for (int round = 0; round < 30; ++round) {
    std::vector<Vec3> points;
    const int n = 4 + round * 7;
    for (int i = 0; i < n; ++i) {
      Vec3 p{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
      points.push_back(round % 3 == 0 ? normalized(p) : p);
    }
    points = snapped(points);
    const Hull hull = hull_of(points);
    check_hull(points, hull);
    check_canonical(points, hull);
  }
}

TEST_CASE("Hulls of lattices, full of points in one plane and on one line") {
  Random random(2);
  for (int round = 0; round < 40; ++round) {
    // A lattice, sheared by powers of two so that it stays exact, with points missing.
    std::set<std::array<int, 3>> chosen;
    for (int i = 0; i < 5 + 5 * round; ++i) {
      chosen.insert({static_cast<int>(random.below(5)), static_cast<int>(random.below(5)),
                     static_cast<int>(random.below(4))});
    }
    std::vector<Vec3> points;
    for (const auto& [i, j, k] : chosen) {
      points.push_back({i / 8.0 + k / 16.0, j / 8.0 - i / 32.0, k / 8.0 + j / 64.0});
    }
    const Hull hull = hull_of(points);
    if (hull.flat) {
      continue;
    }
    check_hull(points, hull);
    check_canonical(points, hull);
  }
}

TEST_CASE("A cube's faces are fans from their smallest vertex") {
  std::vector<Vec3> points;
  for (int i = 0; i < 27; ++i) {
    points.push_back({(i % 3) / 2.0, (i / 3 % 3) / 2.0, (i / 9) / 2.0});
  }
  const Hull hull = hull_of(points);
  CHECK(hull.vertices == std::vector<std::uint32_t>{0, 2, 6, 8, 18, 20, 24, 26});
  CHECK(hull.triangles.size() == 12);
  CHECK(hull.volume(points) == Approx(1.0));
  CHECK(std::count(hull.edges.begin(), hull.edges.end(), std::array<std::uint32_t, 2>{0, 8}) == 1);
  CHECK(std::count(hull.edges.begin(), hull.edges.end(), std::array<std::uint32_t, 2>{2, 6}) == 0);
}

TEST_CASE("Lifted faces: all points of a flat face become hull vertices") {
  std::vector<Vec3> points;
  for (int i = 0; i < 125; ++i) {
    points.push_back({(i % 5) / 8.0, (i / 5 % 5) / 8.0, (i / 25) / 8.0});
  }
  segment::HullBuilder builder(points);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  Hull hull;
  builder.build(order, hull, 1e-6);
  CHECK(hull.vertices.size() == 98);
  CHECK(hull.volume(points) == Approx(0.125));
  // Delaunay: no edge is longer than the diagonal of a small square.
  for (const auto& [a, b] : hull.edges) {
    CHECK(length(points[a] - points[b]) < 0.18);
  }
}

TEST_CASE("A sphere on an exact grid, nearly flat caps and slivers") {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double a = 2.0 * M_PI * i / 40;
      const double b = M_PI * j / 19 - M_PI / 2;
      points.push_back({std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), 1e-5 * std::sin(b)});
    }
  }
  points = snapped(points);
  const Hull hull = hull_of(points);
  check_hull(points, hull);
}

TEST_CASE("Points in a plane, on a line and in one place") {
  std::vector<Vec3> square;
  for (int i = 0; i < 9; ++i) {
    square.push_back({(i % 3) / 4.0, (i / 3) / 4.0, (i % 3) / 8.0});
  }
  const Hull flat = hull_of(square);
  CHECK(flat.flat);
  CHECK(flat.vertices == std::vector<std::uint32_t>{0, 2, 6, 8});
  CHECK(flat.edges == std::vector<std::array<std::uint32_t, 2>>{{0, 2}, {0, 6}, {2, 8}, {6, 8}});
  CHECK(flat.volume(square) == 0.0);
  const Hull line = hull_of({{0, 0, 0}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}});
  CHECK(line.flat);
  CHECK(line.edges.empty());
  CHECK(line.vertices == std::vector<std::uint32_t>{0, 1});
  const Hull point = hull_of({{0.5, 0, 0}, {0.5, 0, 0}});
  CHECK(point.edges.empty());
  CHECK(point.vertices.size() == 1);
}

namespace {

// The nearest plane that is found by directions is the one that a look at all planes finds.

Vec3 direction(Random& random) {
  const auto along = [&] { return 2.0 * random.unit() - 1.0; };
  return normalized({along(), along(), along()});
}

double nearest_of_all(const std::vector<segment::HullPlane>& planes, Vec3 p, Vec3 n, double limit,
                      double least_cosine) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const segment::HullPlane& plane : planes) {
    const double distance = plane.offset - dot(plane.normal, p);
    if (distance <= limit && dot(plane.normal, n) > least_cosine && plane.number % 3 != 0) {
      nearest = std::min(nearest, distance);
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE("planes found by their directions are the nearest ones that count") {
  Random random(11);
  segment::PlaneDirections directions;
  std::size_t found = 0;
  for (const std::uint32_t count : {0U, 1U, 2U, 35U, 400U, 5000U}) {
    for (const bool boxes : {false, true}) {
      // Round hulls away from the origin, and such whose planes all lie along the axes.
      const Vec3 centre{0.3, -0.2, 0.4};
      std::vector<segment::HullPlane> planes;
      for (std::uint32_t i = 0; i < count; ++i) {
        Vec3 normal = direction(random);
        if (boxes) {
          normal = {std::round(normal.x), std::round(normal.y), std::round(normal.z)};
          normal = normalized(normal == Vec3{} ? Vec3{0.0, 0.0, -1.0} : normal);
        }
        planes.push_back({normal, dot(normal, centre) + 0.4 + 0.2 * random.unit(), i});
      }
      directions.assign(planes, centre);
      for (int question = 0; question < 300; ++question) {
        const Vec3 p = centre + 0.39 * random.unit() * direction(random);
        const Vec3 n = direction(random);
        const double limit = 0.3 * random.unit();
        const double least_cosine = question % 2 == 0 ? -2.0 : -0.3;
        const double expected = nearest_of_all(planes, p, n, limit, least_cosine);
        found += std::isfinite(expected) ? 1U : 0U;
        REQUIRE(directions.nearest(p, n, limit, least_cosine, [](const segment::HullPlane& plane) {
          return plane.number % 3 != 0;
        }) == expected);
      }
    }
  }
  CHECK(found > 300);
}

}  // namespace ridgecraft
