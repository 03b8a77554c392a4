// SPDX-License-Identifier: GPL-3.0-or-later
// Turns that lay a surface on itself, with and without mirror planes, and beside what isn't turned.
#include "prepare/symmetry/rotations.hpp"

#include <cmath>
#include <optional>

#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::PartialRotation;
using prepare::widest_rotation;

namespace {

constexpr double near = 0.02;

/// A tower whose floors are turned against each other: no mirror plane.
mesh::Surface twisted(int sides) {
  return test::mapped(test::revolve({{0, 0}, {1, 0}, {1.2, 1}, {0.8, 2}, {0, 2}}, sides), [](Vec3 p) {
    const double a = 0.3 * p.z * p.z;
    return Vec3{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
  });
}

Vec3 put_elsewhere(Vec3 p) {
  return 12.0 * Vec3{0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z} + Vec3{3, 2, 1};
}

/// Every edge comes back after so many turns, and no earlier.
void check_orbits(const PartialRotation& rotation) {
  for (const EdgeId e : ids<EdgeId>(rotation.edge.size())) {
    EdgeId at = e;
    for (unsigned i = 1; i <= rotation.order; ++i) {
      at = rotation.edge[at];
      REQUIRE(at.valid());
      CHECK((at == e) == (i == rotation.order));
    }
  }
}

}  // namespace

TEST_CASE("turned bodies and towers have their turn, wherever they stand", "[symmetry]") {
  for (const int sides : {5, 6, 12}) {
    for (const mesh::Surface& s :
         {twisted(sides), test::mapped(test::shuffled(twisted(sides), 4), put_elsewhere)}) {
      const std::optional<PartialRotation> found = widest_rotation(s, near, 0.5, 2);
      REQUIRE(found.has_value());
      CHECK(found->order == static_cast<unsigned>(sides));
      check_orbits(*found);
    }
  }
}

TEST_CASE("a brick is turned by a half, a lopsided body not at all", "[symmetry]") {
  const mesh::Surface box = test::mapped(test::cube(), [](Vec3 p) { return Vec3{p.x, 2 * p.y, 3 * p.z}; });
  const std::optional<PartialRotation> half = widest_rotation(box, near, 0.5, 2);
  REQUIRE(half.has_value());
  CHECK(half->order == 2);
  const mesh::Surface odd = test::mapped(
      test::star_shaped(
          [](Vec3 d) { return 1.0 + 0.3 * d.x + 0.2 * std::sin(3.0 * d.y + d.z) + 0.2 * d.z * d.x; }, 12, 7),
      put_elsewhere);
  CHECK_FALSE(widest_rotation(odd, near, 0.5, 2).has_value());
}

TEST_CASE("half turns don't hide the turn of a wheel, however it lies", "[symmetry]") {
  const mesh::Surface wheel =
      test::mapped(test::revolve({{0, 0}, {1, 0}, {1, 0.4}, {0, 0.4}}, 3), [](Vec3 p) {
        return Vec3{p.x, p.y, p.z - 0.2};
      });
  for (const auto& laid : {+[](Vec3 p) { return p; },
                           +[](Vec3 p) {
                             return Vec3{p.z, p.x, p.y};
                           },
                           +[](Vec3 p) {
                             return Vec3{p.y, p.z, p.x};
                           },
                           +[](Vec3 p) { return put_elsewhere(p); }}) {
    const std::optional<PartialRotation> found = widest_rotation(test::mapped(wheel, laid), near, 0.5, 2);
    REQUIRE(found.has_value());
    CHECK(found->order == 3);
  }
}

TEST_CASE("what stands on one side only doesn't hide a turn", "[symmetry]") {
  const mesh::Surface tower = twisted(6);
  const mesh::Surface door = test::mapped(test::cube(), [](Vec3 p) {
    return 0.2 * p + Vec3{1.1, -0.1, 0.3};
  });
  const std::optional<PartialRotation> found = widest_rotation(test::together({tower, door}), near, 0.5, 2);
  REQUIRE(found.has_value());
  CHECK(found->order == 6);
  for (const EdgeId e : ids<EdgeId>(found->edge.size())) {
    CHECK((e.value() < tower.edge_count()) == found->edge[e].valid());
  }
}
