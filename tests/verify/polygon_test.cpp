// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry that overlap rests on, against slow ways to the same answers.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "verify/geometry/geometry.hpp"

using namespace ridgecraft;
using verify::Polygon;

namespace {

constexpr double pi = std::numbers::pi;

Polygon random_convex(Random& random, std::uint32_t corners) {
  std::vector<double> angles(corners);
  for (double& angle : angles) {
    angle = 2.0 * pi * random.unit();
  }
  std::sort(angles.begin(), angles.end());
  const Vec2 centre{4.0 * random.unit() - 2.0, 4.0 * random.unit() - 2.0};
  const Vec2 radius{0.2 + 2.8 * random.unit(), 0.2 + 2.8 * random.unit()};
  Polygon polygon;
  for (const double angle : angles) {
    polygon.push_back(centre + Vec2{radius.x * std::cos(angle), radius.y * std::sin(angle)});
  }
  return polygon;
}

/// Round a centre with jumping radii: simple, and anything but convex.
Polygon random_star(Random& random, std::uint32_t corners) {
  Polygon polygon;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * pi * (i + 0.8 * random.unit()) / corners;
    const double radius = 1.0 + 9.0 * random.unit();
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return polygon;
}

double depth_by_directions(const Polygon& a, const Polygon& b) {
  double best = INFINITY;
  constexpr int directions = 20000;
  for (int i = 0; i < directions; ++i) {
    const Vec2 d{std::cos(2.0 * pi * i / directions), std::sin(2.0 * pi * i / directions)};
    double reach = -INFINITY;
    double nearest = INFINITY;
    for (const Vec2 p : a) {
      reach = std::fmax(reach, dot(p, d));
    }
    for (const Vec2 p : b) {
      nearest = std::fmin(nearest, dot(p, d));
    }
    best = std::fmin(best, reach - nearest);
  }
  return std::fmax(best, 0.0);
}

bool inside(const Polygon& polygon, Vec2 p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      in = !in;
    }
  }
  return in;
}

/// Every straight corner, tooth and gap that a comb can have.
Polygon comb(int teeth) {
  Polygon polygon = {{0, -5}, {2.0 * teeth, -5}};
  for (int i = teeth; i > 0; --i) {
    const double x = 2.0 * i;
    polygon.insert(polygon.end(), {{x, 0}, {x, 10}, {x - 1, 10}, {x - 1, 5}, {x - 1, 0}});
  }
  polygon.push_back({0, 0});
  return polygon;
}

}  // namespace

TEST_CASE("penetration is the shortest way apart", "[verify]") {
  Random random(3);
  int met = 0;
  for (int round = 0; round < 100; ++round) {
    const Polygon a = random_convex(random, 3 + random.below(6));
    const Polygon b = random_convex(random, 3 + random.below(6));
    const double depth = verify::penetration(a, b);
    const double slow = depth_by_directions(a, b);
    // Directions between those that are tried make the slow depth too large, never too small.
    CHECK(depth <= slow + 1e-12);
    CHECK(depth >= slow - 0.002);
    CHECK(depth == Approx(verify::penetration(b, a)).margin(1e-12));
    met += depth > 0.0 ? 1 : 0;
  }
  CHECK(met > 20);
  CHECK(met < 100);
}

TEST_CASE("convex parts are convex, apart, and together the polygon", "[verify]") {
  Random random(5);
  std::vector<Polygon> polygons = {comb(1), comb(7), comb(100)};
  for (int round = 0; round < 60; ++round) {
    polygons.push_back(random_star(random, 4 + random.below(60)));
  }
  for (const Polygon& polygon : polygons) {
    const std::vector<Polygon> parts = verify::convex_parts(polygon, {});
    double area = 0.0;
    for (const Polygon& part : parts) {
      CHECK(verify::is_convex(part));
      area += doubled_area(part);
    }
    CHECK(area == Approx(doubled_area(polygon)));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        CHECK(verify::penetration(parts[i], parts[j]) < 1e-9);
      }
    }
    for (int k = 0; k < 50; ++k) {
      const Vec2 p{20.0 * random.unit() - 10.0, 20.0 * random.unit() - 10.0};
      const bool in_part =
          std::any_of(parts.begin(), parts.end(), [p](const Polygon& q) { return inside(q, p); });
      CHECK(in_part == inside(polygon, p));
    }
  }
  // Hertel and Mehlhorn: at most four times as many parts as there can be, and a comb needs one per tooth and
  // its back.
  CHECK(verify::convex_parts(comb(100), {}).size() <= 404);
  CHECK(verify::convex_parts(Polygon{{0, 0}, {1, 0}, {2, 0}}, {}).empty());
}

TEST_CASE("a turned round polygon is one part, and a clockwise one is turned over", "[verify]") {
  Polygon square = {{0, 0}, {0, 2}, {2, 2}, {2, 0}};
  const std::vector<Polygon> parts = verify::convex_parts(square, {});
  REQUIRE(parts.size() == 1);
  CHECK(doubled_area(parts[0]) == 8.0);
}

TEST_CASE("simple polygons differ from those that cross or touch themselves", "[verify]") {
  Random random(11);
  for (int round = 0; round < 50; ++round) {
    CHECK(verify::is_simple(random_star(random, 4 + random.below(40)), {}));
  }
  CHECK(verify::is_simple(comb(200), {}));
  CHECK_FALSE(verify::is_simple(Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}));          // bow tie
  CHECK_FALSE(verify::is_simple(Polygon{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, {}));  // corner on side
  CHECK_FALSE(verify::is_simple(Polygon{{0, 0}, {4, 0}, {4, 4}, {6, 4}, {4, 4}, {0, 4}}, {}));  // spike
  CHECK_FALSE(verify::is_simple(Polygon{{0, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}, {}));          // runs back
  CHECK_FALSE(
      verify::is_simple(Polygon{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {4, 8}, {-4, 8}, {2, 2}, {0, 4}}, {}));
  // A star of five points turns left everywhere, twice round.
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) {
    pentagram.push_back({std::cos(4.0 * pi * i / 5.0), std::sin(4.0 * pi * i / 5.0)});
  }
  CHECK_FALSE(verify::is_convex(pentagram));
  CHECK_FALSE(verify::is_simple(pentagram, {}));
}

TEST_CASE("the box tree finds what a look at all boxes finds", "[verify]") {
  Random random(17);
  for (const std::uint32_t count : {0U, 1U, 5U, 300U}) {
    std::vector<Box2> boxes(count);
    for (Box2& box : boxes) {
      const Vec2 low{std::floor(20.0 * random.unit()), std::floor(20.0 * random.unit())};
      box.add(low);
      box.add(low + Vec2{std::floor(5.0 * random.unit()), 15.0 * random.unit() * random.unit()});
    }
    const verify::BoxFinder tree(boxes);
    for (const Box2& box : boxes) {
      std::vector<std::size_t> found;
      tree.for_each_overlapping(box, [&found](std::size_t i) { found.push_back(i); });
      std::sort(found.begin(), found.end());
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box2& other = boxes[i];
        if (box.low.x < other.high.x && other.low.x < box.high.x && box.low.y < other.high.y &&
            other.low.y < box.high.y) {
          expected.push_back(i);
        }
      }
      CHECK(found == expected);
    }
  }
}

TEST_CASE("a rigid motion is found again, and a mirror image isn't one", "[verify]") {
  Random random(23);
  const auto random_point = [&random] {
    return Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
  };
  for (int round = 0; round < 200; ++round) {
    const verify::Motion motion{verify::Turn::about(normalized(random_point()), 2.0 * pi * random.unit()),
                                100.0 * random_point()};
    std::vector<Vec3> from(3 + random.below(20));
    std::vector<Vec3> to;
    // Every fourth set is flat, and every fifth a line: their turns are the hard ones.
    for (Vec3& p : from) {
      p = 50.0 * random_point();
      p.z = round % 4 == 0 ? 0.0 : p.z;
      p.y = round % 5 == 0 ? 0.0 : p.y;
      to.push_back(motion(p));
    }
    const verify::Motion found = verify::best_motion(from, to);
    for (std::size_t i = 0; i < from.size(); ++i) {
      CHECK(length(found(from[i]) - to[i]) < 1e-10);
    }
  }
  const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3> mirrored = {{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const verify::Motion best = verify::best_motion(corner, mirrored);
  double worst = 0.0;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    worst = std::fmax(worst, length(best(corner[i]) - mirrored[i]));
  }
  CHECK(worst > 0.3);
}
