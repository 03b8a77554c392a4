// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest plane that is found by directions is the one that a look at all planes finds.
#include "segment/hull/plane_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

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
