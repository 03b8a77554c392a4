// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segmented.hpp"

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

namespace {

using segment::Bridge;
using test::tolerance;

/// A tetrahedron with two corners that are 0.02 apart, 1 and 2, and its bridges, all open.
struct Thin {
  explicit Thin(std::vector<Vec3> corners = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.02, 0}, {0.2, 0.1, 0.4}})
      : points(std::move(corners)) {
    for (Vec3& p : points) {
      p = segment::snap_to_grid(p);
    }
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    segment::HullBuilder(points).build(all, hull);
    for (const auto& [a, b] : hull.edges) {
      bridges.emplace_back();
      bridges.back().a = a;
      bridges.back().b = b;
    }
  }
  [[nodiscard]] std::uint32_t number(std::uint32_t a, std::uint32_t b) const {
    const auto at = std::find_if(bridges.begin(), bridges.end(),
                                 [&](const Bridge& bridge) { return bridge.a == a && bridge.b == b; });
    REQUIRE(at != bridges.end());
    return static_cast<std::uint32_t>(at - bridges.begin());
  }
  Bridge& between(std::uint32_t a, std::uint32_t b) { return bridges[number(a, b)]; }
  bool derive(std::uint32_t a, std::uint32_t b) {
    return segment::derive_bridge(number(a, b), hull, points, tolerance, bridges);
  }

  std::vector<Vec3> points;
  segment::Hull hull;
  std::vector<Bridge> bridges;
};

}  // namespace

TEST_CASE("A bridge is derived from the one beside it, with bounds that grow by twice their distance") {
  Thin thin;
  CHECK_FALSE(thin.derive(0, 2));  // nothing is known yet
  thin.between(0, 1).length = 0.6;
  thin.between(0, 1).known = segment::Searched{.concavity = 0.3, .reach = {0.25, 0.35}};
  thin.between(0, 1).high = true;
  REQUIRE(thin.derive(0, 2));
  const Bridge& derived = thin.between(0, 2);
  CHECK(derived.high);
  CHECK(derived.length == Approx(0.62));
  const auto bounds = segment::concavity_bounds(derived);
  REQUIRE(bounds);
  CHECK(bounds->least == Approx(0.26));
  CHECK(bounds->most == Approx(0.34));
  CHECK(segment::greatest_concavity(derived) == bounds->most);
  CHECK(segment::sub_valleys(derived, thin.bridges) == std::array{0.25, 0.35});
}

TEST_CASE("A bridge whose bounds are on both sides of the tolerance stays open") {
  Thin thin;
  for (const double concavity : {0.07, 0.09, 0.1, 0.13}) {
    thin.between(0, 1).known = segment::Searched{.concavity = concavity, .reach = {}};
    CHECK_FALSE(thin.derive(0, 2));
    CHECK(thin.between(0, 2).is_open());
  }
  thin.between(0, 1).known = segment::Searched{.concavity = 0.05, .reach = {}};
  REQUIRE(thin.derive(0, 2));
  CHECK_FALSE(thin.between(0, 2).high);
}

TEST_CASE("Bridges whose ends are joined are no sources") {
  Thin thin;
  thin.between(0, 1).known = segment::Joined{};
  CHECK_FALSE(thin.derive(0, 2));
  CHECK_FALSE(segment::concavity_bounds(thin.between(0, 1)));
  CHECK(segment::greatest_concavity(thin.between(0, 1)) == 0.0);
}

TEST_CASE("A derived bridge that runs the other way takes the sub-valleys of its ends crossed") {
  // The near corners are 0 and 3: the smaller end of the source is near the larger one of the other bridge.
  Thin other({{0.5, 0, 0}, {0, 0, 0}, {0.2, 0.1, 0.4}, {0.5, 0.02, 0}});
  other.between(0, 1).known = segment::Searched{.concavity = 0.3, .reach = {0.25, 0.35}};
  REQUIRE(other.derive(1, 3));
  CHECK(std::get<segment::Derived>(other.between(1, 3).known).crossed);
  CHECK(segment::sub_valleys(other.between(1, 3), other.bridges) == std::array{0.35, 0.25});
}

}  // namespace ridgecraft
