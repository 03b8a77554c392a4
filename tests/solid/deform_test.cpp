// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

Vec3 affine(Vec3 p) {
  return {2.0 * p.x + 0.5 * p.y - 3.0, 0.3 * p.x - p.y + p.z, 0.1 * p.x + 0.7 * p.z + 11.0};
}

}  // namespace

TEST_CASE("Mean value coordinates reproduce affine maps, on the cage too") {
  const solid::Body cage = solid::body_of(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 1));
  solid::Body moved = cage;
  for (Vec3& p : moved.points) {
    p = affine(p);
  }
  Random random(9);
  std::vector<Vec3> points = cage.points;
  for (const auto& [a, b, c] : cage.triangles) {
    points.push_back((cage.points[a] + cage.points[b] + cage.points[c]) / 3.0);  // on a face
    points.push_back(0.5 * (cage.points[a] + cage.points[b]));                   // on an edge
  }
  for (int i = 0; i < 500; ++i) {
    points.push_back({random.unit(), random.unit(), random.unit()});
    points.push_back({1.0 + random.unit(), 1.0 + random.unit(), 2.0 * random.unit()});
  }
  const auto result = solid::deform(points, cage, moved, Context{});
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i, points[i].x, points[i].y, points[i].z);
    CHECK(length(result[i] - affine(points[i])) < 1e-6);
  }
}

TEST_CASE("A corner that is pulled takes what is near with it, and more the nearer") {
  const solid::Body cage = solid::body_of(test::voxels({{0, 0, 0}}, 1));
  solid::Body pulled = cage;
  std::size_t corner = 0;
  for (std::size_t v = 0; v < cage.points.size(); ++v) {
    if (cage.points[v] == Vec3{1.0, 1.0, 1.0}) {
      corner = v;
    }
  }
  pulled.points[corner] = {2.0, 2.0, 2.0};
  const std::vector<Vec3> points{{0.1, 0.1, 0.1}, {0.5, 0.5, 0.5}, {0.9, 0.9, 0.9}};
  const auto result = solid::deform(points, cage, pulled, Context{});
  double before = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double shift = length(result[i] - points[i]);
    CHECK(shift > before);
    before = shift;
  }
  CHECK(before < std::sqrt(3.0));
}

}  // namespace ridgecraft
