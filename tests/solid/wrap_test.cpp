// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "segment/segment.hpp"
#include "solid/solid.hpp"
#include "solid/solid_checks.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

void check_around(const solid::Body& body, std::span<const Vec3> points) {
  REQUIRE(test::closed_and_manifold(body));
  for (const Vec3 p : points) {
    CHECK(test::winding_number(body, p) == Approx(1.0).margin(1e-6));
  }
}

/// A surface with each face left out at even odds.
mesh::Surface torn(const mesh::Surface& whole, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(whole.face_count())) {
    if (random.below(100) < 45) {
      continue;
    }
    // Corners of its own for each face: what is left needn't be a manifold otherwise.
    std::array<VertexId, 3> face;
    for (unsigned k = 0; k < 3; ++k) {
      face[k] = VertexId(static_cast<std::uint32_t>(points.size()));
      points.push_back(whole.point(whole.vertices(f)[k]));
    }
    faces.push_back(face);
  }
  return {points, faces};
}

}  // namespace

TEST_CASE("A cage is closed, has at most the faces asked for and encloses every vertex") {
  const mesh::Surface l = test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 2, 0}}, 2);
  const auto parts = segment::segment(l, {}, {}, Context{});
  const auto bodies = solid::part_hulls(l, parts, {}, Context{});
  double before = INFINITY;
  for (const std::size_t faces : {100U, 400U, 1600U}) {
    const solid::Body body = solid::cage(bodies, {.faces = faces}, Context{});
    CHECK(body.triangles.size() <= faces);
    check_around(body, l.points());
    const double volume = solid::mass_properties(body).volume;
    CHECK(volume < before);
    before = volume;
  }
  CHECK(before < 5.0 * 1.25);
}

TEST_CASE("A shell is closed around a surface with 45 % of its faces gone") {
  const mesh::Surface whole = test::sphere(32, 24);
  const mesh::Surface broken = torn(whole, 5);
  const solid::Body body = solid::shell(broken, {.opening = 0.25, .offset = 0.005}, Context{});
  check_around(body, broken.points());
  CHECK(test::winding_number(body, {0.0, 0.0, 0.0}) == Approx(1.0).margin(1e-6));
  CHECK(solid::mass_properties(body).volume == Approx(4.19).margin(0.35));
}

}  // namespace ridgecraft
