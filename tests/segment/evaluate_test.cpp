// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/judging/evaluate.hpp"

#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/surface/enclosing_ball.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {

TEST_CASE("Volume ratio of hulls") {
  const mesh::Surface l = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2);
  CHECK(segment::enclosed_volume(l) == Approx(3.0));
  const std::vector<std::uint32_t> whole(l.face_count(), 0);
  CHECK(segment::hull_volume_ratio(l, whole, 512, Context{}) == Approx(3.5 / 3.0).margin(0.02));
  std::vector<std::uint32_t> halves;
  for (const FaceId f : ids<FaceId>(l.face_count())) {
    double x = 0.0;
    for (const VertexId v : l.vertices(f)) {
      x += l.point(v).x / 3.0;
    }
    halves.push_back(x < 1.0 + 1e-9 ? 0 : 1);
  }
  CHECK(segment::hull_volume_ratio(l, halves, 512, Context{}) == Approx(1.0).margin(0.02));
}

TEST_CASE("The smallest ball holds all points and is held by few of them") {
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> points;
    const std::uint32_t n = 1 + random.below(40);
    for (std::uint32_t i = 0; i < n; ++i) {
      points.push_back({random.unit(), random.unit() * (round % 3), random.unit() * (round % 2)});
    }
    const segment::Ball ball = segment::smallest_enclosing_ball(points);
    // Smallest: no ball with its centre a little to any side is smaller.
    for (int k = 0; k < 27; ++k) {
      const Vec3 moved = ball.center + 1e-4 * Vec3{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
      double radius = 0.0;
      for (const Vec3 p : points) {
        radius = std::max(radius, length(p - moved));
      }
      CHECK(radius >= ball.radius - 1e-11);
      if (k == 13) {
        CHECK(radius <= ball.radius + 1e-11);
      }
    }
  }
}

}  // namespace ridgecraft
