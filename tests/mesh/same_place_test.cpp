// SPDX-License-Identifier: GPL-3.0-or-later
// Points at one place, against looking at all pairs.
#include "mesh/foundation/same_place.hpp"

#include <catch2/catch.hpp>

#include "mesh/foundation/context.hpp"
#include "mesh/foundation/curve_order.hpp"

namespace ridgecraft {

TEST_CASE("The first point at each place is what looking at all pairs finds") {
  Random random(5);
  for (const std::uint32_t places : {1U, 3U, 40U, 100000U}) {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> counts;
    for (int i = 0; i < 300; ++i) {
      const auto coordinate = [&] { return static_cast<double>(random.below(places)) / 3.0 - 0.0; };
      points.push_back({coordinate(), i % 2 == 0 ? 0.0 : -0.0, coordinate()});
      counts.push_back(random.below(4) > 0 ? 1 : 0);
    }
    const std::vector<std::uint32_t> all = mesh::first_at_place(points);
    const std::vector<std::uint32_t> some = mesh::first_at_place(points, counts);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      std::uint32_t first = 0;
      while (points[first] != points[i]) {
        ++first;
      }
      CHECK(all[i] == first);
      std::uint32_t counted = counts[i] == 0 ? i : 0;
      while (points[counted] != points[i] || (counts[counted] == 0 && counted != i)) {
        ++counted;
      }
      CHECK(some[i] == counted);
    }
  }
  CHECK(mesh::first_at_place({}).empty());
}

TEST_CASE("A curve's order has each point once, and points of one cell in theirs") {
  const std::vector<Vec3> points{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 1e-9}, {1, 0, 0}, {0, 1, 0}};
  CHECK(mesh::curve_order(points) == std::vector<std::uint32_t>{1, 3, 4, 5, 0, 2});
  CHECK(mesh::curve_order({}).empty());
  const std::vector<Vec3> one{{7, 7, 7}, {7, 7, 7}};
  CHECK(mesh::curve_order(one) == std::vector<std::uint32_t>{0, 1});
}

}  // namespace ridgecraft
