// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a polygon fits a rectangle in some turn, beside a scan of many turns.
#include "base/geometry.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

using namespace ridgecraft;

namespace {

Vec2 extents(const std::vector<Vec2>& hull, double angle) {
  Box2 box;
  for (const Vec2 p : hull) {
    box.add({std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y});
  }
  return box.size();
}

std::vector<Vec2> oval(std::size_t corners, Random& random) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * random.unit();
    points.push_back({40.0 * std::cos(angle), 25.0 * std::sin(angle)});
  }
  return convex_hull(points);
}

}  // namespace

TEST_CASE("what fits a rectangle in one of many turns is found, with few corners and with many",
          "[rectangle]") {
  Random random(7);
  for (const std::size_t corners : {3U, 8U, 60U, 70U, 500U}) {
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Vec2> hull = oval(corners, random);
      const Rectangle rectangle{30.0 + 60.0 * random.unit(), 20.0 + 60.0 * random.unit()};
      const std::optional<double> angle = angle_to_fit(hull, rectangle);
      bool seen = false;
      for (int step = 0; step < 720 && !seen; ++step) {
        const Vec2 size = extents(hull, step * std::numbers::pi / 720.0);
        seen = size.x <= rectangle.width && size.y <= rectangle.height;
      }
      INFO(corners << " corners, trial " << trial);
      CHECK((angle || !seen));
      if (angle) {
        const Vec2 size = extents(hull, *angle);
        CHECK(size.x <= rectangle.width + 1e-6);
        CHECK(size.y <= rectangle.height + 1e-6);
      }
    }
  }
}
