// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of rotation, with and without mirror planes.
#include "prepare/symmetry/rotations.hpp"

#include <cmath>

#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::find_rotations;
using prepare::Rotation;

namespace {

/// A tower whose floors are turned against each other: no mirror plane.
mesh::Surface twisted(int sides) {
  return test::mapped(test::revolve({{0, 0}, {1, 0}, {1.2, 1}, {0.8, 2}, {0, 2}}, sides), [](Vec3 p) {
    const double a = 0.3 * p.z * p.z;
    return Vec3{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
  });
}

Vec3 moved(Vec3 p) {
  return 12.0 * Vec3{0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z} + Vec3{3, 2, 1};
}

}  // namespace

TEST_CASE("turned bodies and towers have their axis and the map of their turn", "[symmetry]") {
  for (const int sides : {5, 6, 12}) {
    for (const mesh::Surface& s : {twisted(sides), test::mapped(test::shuffled(twisted(sides), 4), moved)}) {
      const std::vector<Rotation> found = find_rotations(s);
      REQUIRE_FALSE(found.empty());
      CHECK(found[0].folds == static_cast<unsigned>(sides));
      CHECK(found[0].maps.whole);
      for (const FaceId f : ids<FaceId>(s.face_count())) {
        FaceId g = f;
        for (int i = 0; i < sides; ++i) {
          g = found[0].maps.face[g];
          CHECK((i + 1 == sides) == (g == f));
        }
      }
    }
  }
}

TEST_CASE("a brick has three axes, a cube thirteen, a lopsided body none", "[symmetry]") {
  const mesh::Surface box = test::mapped(test::cube(), [](Vec3 p) { return Vec3{p.x, 2 * p.y, 3 * p.z}; });
  CHECK(find_rotations(box).size() == 3);
  const std::vector<Rotation> cube = find_rotations(test::mapped(test::cube(), moved));
  CHECK(cube.size() == 13);
  CHECK(cube[0].folds == 4);
  CHECK(cube[3].folds == 3);
  CHECK(cube[7].folds == 2);
  const mesh::Surface odd = test::mapped(twisted(6), [](Vec3 p) {
    return p.x > 0.9 ? p - Vec3{0.1, 0, 0} : p;
  });
  CHECK(find_rotations(odd).empty());
}
