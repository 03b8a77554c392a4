// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "mesh/model/surface_distance.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using mesh::Surface;

TEST_CASE("a cube has 12 faces, 18 edges and mountain folds of 90 degrees", "[surface]") {
  const Surface cube = test::cube();
  CHECK(cube.vertex_count() == 8);
  CHECK(cube.face_count() == 12);
  CHECK(cube.edge_count() == 18);
  CHECK(cube.component_count() == 1);
  int mountains = 0;
  for (const EdgeId e : ids<EdgeId>(cube.edge_count())) {
    CHECK_FALSE(cube.is_border(e));
    const double degrees = cube.fold_angle(e) * 180.0 / std::numbers::pi;
    if (std::abs(degrees) > 1.0) {
      CHECK(degrees == Approx(-90.0));
      ++mountains;
    }
  }
  CHECK(mountains == 12);
}

TEST_CASE("the inner edge of an L is a valley", "[surface]") {
  const Surface shape = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  int valleys = 0;
  for (const EdgeId e : ids<EdgeId>(shape.edge_count())) {
    valleys += shape.fold_angle(e) > 1.0 ? 1 : 0;
  }
  CHECK(valleys == 1);
}

TEST_CASE("twins run along one edge in opposite directions", "[surface]") {
  const Surface shape = test::sphere(16, 8);
  CHECK(shape.face_count() == 16 * 14);
  for (const CornerId c : ids<CornerId>(shape.corner_count())) {
    const CornerId d = shape.twin(c);
    REQUIRE(d.valid());
    CHECK(shape.twin(d) == c);
    CHECK(shape.edge(d) == shape.edge(c));
    CHECK(shape.vertex(d) == shape.vertex(mesh::next(c)));
    CHECK(shape.vertex(mesh::next(d)) == shape.vertex(c));
  }
}

TEST_CASE("shapes for tests are oriented outward", "[surface]") {
  for (const Surface& shape : {test::cube(), test::tetrahedron(), test::sphere(12, 6)}) {
    double six_volumes = 0.0;
    for (const FaceId f : ids<FaceId>(shape.face_count())) {
      const auto [a, b, c] = shape.vertices(f);
      six_volumes += dot(shape.point(a), cross(shape.point(b), shape.point(c)));
    }
    CHECK(six_volumes > 0.0);
  }
}

TEST_CASE("an open tube has two borders", "[surface]") {
  const Surface tube = test::revolve({{1, 0}, {1, 1}}, 12);
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(tube.edge_count())) {
    border += tube.is_border(e) ? 1U : 0U;
  }
  CHECK(border == 24);
}

TEST_CASE("coordinates come through bit for bit", "[surface]") {
  const Surface s({{0.1, 0.2, 0.3}, {1, 0, 0}, {0, 1, 0}}, {{VertexId(0), VertexId(1), VertexId(2)}});
  CHECK(s.point(VertexId(0)) == Vec3{0.1, 0.2, 0.3});
}

TEST_CASE("what is remembered of near places changes no distance", "[surface]") {
  const mesh::Surface ball = test::sphere(24, 12);
  const mesh::Surface fine = test::sphere(60, 30);
  const mesh::SurfaceTree tree(ball, 0.2);
  const mesh::SurfaceTree others(fine, 0.05);
  Random random(18);
  mesh::NearField field(tree, 0.1);
  FaceId near;
  std::size_t inside = 0;
  for (int i = 0; i < 200000; ++i) {
    // Far ones have no cell.
    const double far = i % 1000 == 0 ? 1e6 : 1.3;
    const Vec3 p{far * (2.0 * random.unit() - 1.0), far * (2.0 * random.unit() - 1.0),
                 far * (2.0 * random.unit() - 1.0)};
    const double distance = tree.distance(p, 0.0);
    REQUIRE(field.contains(p) == (distance <= 0.1));
    inside += distance <= 0.1 ? 1U : 0U;
    const double found = tree.distance(p, 0.2, near);
    REQUIRE((found == distance || (distance <= found && found <= 0.2)));
  }
  CHECK(inside > 20000);
  CHECK(inside < 100000);
  double greatest = 0.0;
  for (const Vec3 p : others.samples()) {
    greatest = std::max(greatest, tree.distance(p, 0.0));
  }
  for (const Vec3 p : tree.samples()) {
    greatest = std::max(greatest, others.distance(p, 0.0));
  }
  CHECK(mesh::greatest_distance(others, tree, 1.0, {}) == greatest);
}
