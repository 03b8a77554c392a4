// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/convex_hull.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

using Place = std::pair<double, double>;

/// Corners of the outline by other code: the hull of all projected points.
std::set<Place> corners_by_hull(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& ids,
                                Vec3 right, Vec3 up) {
  std::vector<Vec2> flat;
  for (const std::uint32_t v : ids) {
    flat.push_back({dot(points[v], right), dot(points[v], up)});
  }
  std::set<Place> corners;
  for (const Vec2 p : convex_hull(flat)) {
    corners.insert({p.x, p.y});
  }
  return corners;
}

}  // namespace

TEST_CASE("A shadow's corners are those of the hull of the projected points") {
  Random random(11);
  const auto signed_unit = [&] { return 2.0 * random.unit() - 1.0; };
  segment::Shadow shadow;
  for (int run = 0; run < 200; ++run) {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> ids;
    const std::uint32_t count = 3 + random.below(300);
    for (std::uint32_t v = 0; v < count; ++v) {
      Vec3 p{signed_unit(), signed_unit(), signed_unit()};
      // Balls, boxes and pencils: many corners, few, and all near a line.
      p = run % 3 == 0 ? p / length(p) : run % 3 == 1 ? p : Vec3{p.x, 0.01 * p.y, 0.01 * p.z};
      points.push_back(p);
      if (v % 5 != 4) {
        ids.push_back(v);
      }
    }
    const Vec3 right = normalized(Vec3{signed_unit(), signed_unit(), signed_unit()});
    const Vec3 up = normalized(cross(right, Vec3{0.3, -0.7, 0.2}));
    shadow.cast(points, ids, right, up);
    std::set<Place> found;
    for (const std::uint32_t v : shadow.corners()) {
      CHECK(std::find(ids.begin(), ids.end(), v) != ids.end());
      found.insert({dot(points[v], right), dot(points[v], up)});
    }
    CHECK(found == corners_by_hull(points, ids, right, up));
    const auto [a, b] = shadow.longest(points);
    CHECK(a < b);
    const auto corners = shadow.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      CHECK(length(points[corners[i]] - points[corners[(i + 1) % corners.size()]]) <=
            length(points[a] - points[b]));
    }
  }
}

TEST_CASE("Few points have a shadow, too") {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 2}};
  segment::Shadow shadow;
  const Vec3 x{1, 0, 0};
  const Vec3 y{0, 1, 0};
  shadow.cast(points, {}, x, y);
  CHECK(shadow.corners().empty());
  const std::vector<std::uint32_t> one{1};
  shadow.cast(points, one, x, y);
  const auto [a, b] = shadow.longest(points);
  CHECK(a == b);
  const std::vector<std::uint32_t> two{0, 1};
  shadow.cast(points, two, x, y);
  CHECK(shadow.corners().size() == 2);
  CHECK(shadow.longest(points) == std::array<std::uint32_t, 2>{0, 1});
}

}  // namespace ridgecraft
