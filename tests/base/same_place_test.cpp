// SPDX-License-Identifier: GPL-3.0-or-later
// Points at one place, against looking at all pairs.
#include "base/same_place.hpp"

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

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
    const std::vector<std::uint32_t> all = first_at_place(points);
    const std::vector<std::uint32_t> some = first_at_place(points, counts);
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
  CHECK(first_at_place({}).empty());
}

}  // namespace ridgecraft
