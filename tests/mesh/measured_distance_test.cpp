// SPDX-License-Identifier: GPL-3.0-or-later
// The greatest distance between two surfaces is found where no sample lies.
#include "mesh/model/measured_distance.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "support/symmetric_shapes.hpp"

using namespace ridgecraft;

namespace {

/// A plate of 100 x 100 in z = 0 in two faces.
mesh::Surface plate() {
  return {{{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}},
          {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(3)}}};
}

/// A roof over the triangle a b c, `height` high at `top`.
mesh::Surface roof(Vec3 top) {
  return {{{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}, top},
          {{VertexId(0), VertexId(1), VertexId(4)},
           {VertexId(1), VertexId(2), VertexId(4)},
           {VertexId(2), VertexId(3), VertexId(4)},
           {VertexId(3), VertexId(0), VertexId(4)}}};
}

double measured(const mesh::Surface& a, const mesh::Surface& b, double spacing) {
  return measured_distance(mesh::SurfaceTree(a, spacing), mesh::SurfaceTree(b, spacing), {});
}

/// Of many random points of `from`.
double sampled(const mesh::Surface& from, const mesh::Surface& to, Random& random) {
  const mesh::SurfaceTree tree(to, INFINITY);
  double greatest = 0.0;
  for (const FaceId f : ids<FaceId>(from.face_count())) {
    const auto [a, b, c] = from.vertices(f);
    for (int i = 0; i < 200; ++i) {
      double u = random.unit();
      double v = random.unit();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3 p =
          from.point(a) + u * (from.point(b) - from.point(a)) + v * (from.point(c) - from.point(a));
      greatest = std::max(greatest, tree.distance(p, greatest));
    }
  }
  return greatest;
}

}  // namespace

TEST_CASE("surfaces that cover the same are at no distance, however they are divided", "[distance]") {
  CHECK(measured(plate(), roof({31.0, 17.0, 0.0}), 1.5) == Approx(0.0).margin(1e-9));
}

TEST_CASE("what lies between all samples is measured", "[distance]") {
  // Two roofs whose ridges meet the other one's faces: the farthest places are on no corner of either.
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const auto top = [&] {
      return Vec3{20.0 + 60.0 * random.unit(), 20.0 + 60.0 * random.unit(), 5.0 + 20.0 * random.unit()};
    };
    const mesh::Surface a = roof(top());
    const mesh::Surface b = roof(top());
    const double fine = measured(a, b, 0.5);
    CHECK(measured(a, b, 40.0) == Approx(fine).epsilon(0.012).margin(0.2));
    CHECK(std::max(sampled(a, b, random), sampled(b, a, random)) <= 1.011 * fine + 0.003);
  }
}

TEST_CASE("no random point of two lumps is farther off than is measured", "[distance]") {
  Random random(11);
  for (int k = 0; k < 10; ++k) {
    const auto lump = [&](int longitudes, int latitudes) {
      return test::mapped(test::scaled(test::sphere(longitudes, latitudes), 40.0), [&](Vec3 p) {
        const auto noise = [&] { return 3.0 * (random.unit() - 0.5); };
        return p + Vec3{noise(), noise(), noise()};
      });
    };
    const mesh::Surface a = lump(8, 5);
    const mesh::Surface b = lump(12, 9);
    const double told = measured(a, b, 1.2);
    const double found = std::max(sampled(a, b, random), sampled(b, a, random));
    CHECK(found <= 1.011 * told + 0.006);
    CHECK(told <= 1.1 * found);
  }
}
