// SPDX-License-Identifier: GPL-3.0-or-later
// The surface: what is derived of triangles, which of others are taken for one, and the distance of two.
#include "mesh/model/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "support/shapes.hpp"
#include "support/symmetric_shapes.hpp"

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

// Which triangles of others are taken for a surface, and what is said of those that aren't.

namespace {

struct PointsAndFaces {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
};

PointsAndFaces triangles_of(const Surface& surface) {
  PointsAndFaces made{{surface.points().begin(), surface.points().end()}, {}};
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    made.faces.push_back(surface.vertices(f));
  }
  return made;
}

std::array<VertexId, 3> face(std::size_t a, std::size_t b, std::size_t c) {
  return {VertexId(a), VertexId(b), VertexId(c)};
}

/// What is said; empty where it is a surface.
std::string fault(const PointsAndFaces& triangles) {
  try {
    Surface::check(triangles.points, triangles.faces);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::unusable_mesh);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("what repair made is a surface, with a border or without", "[surface]") {
  for (const Surface& surface : {test::cube(), test::sphere(12, 6), test::voxels({{0, 0, 0}, {1, 0, 0}})}) {
    PointsAndFaces triangles = triangles_of(surface);
    CHECK(fault(triangles).empty());
    triangles.faces.pop_back();
    CHECK(fault(triangles).empty());
  }
  for (const auto& sample :
       std::filesystem::directory_iterator(std::filesystem::path(RIDGECRAFT_SOURCE_DIR) / "samples")) {
    const std::string suffix = sample.path().extension().string();
    if (suffix == ".obj" || suffix == ".stl" || suffix == ".ply" || suffix == ".off") {
      INFO(sample.path());
      CHECK(fault(triangles_of(mesh::read(sample.path(), {}, {}).surface)).empty());
    }
  }
}

TEST_CASE("each broken invariant is told in one sentence", "[surface]") {
  const PointsAndFaces cube = triangles_of(test::cube());
  PointsAndFaces broken = cube;
  broken.points[3].y = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault(broken) == "point 3 has a coordinate that isn't a finite number");

  broken = cube;
  broken.faces[5][1] = VertexId(8);
  CHECK(fault(broken) == "face 5 names a vertex that isn't there; there are 8");
  broken.faces[5][1] = VertexId();
  CHECK(fault(broken) == "face 5 names a vertex that isn't there; there are 8");

  broken = cube;
  broken.faces[5][1] = broken.faces[5][0];
  CHECK(fault(broken) == "face 5 has a vertex twice");

  broken = cube;
  broken.points.push_back({2.0, 2.0, 2.0});
  CHECK(fault(broken) == "point 8 is no corner of a face");

  // One turned around, one twice, three at an edge.
  const std::vector<Vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  CHECK(fault({{five.begin(), five.begin() + 4}, {face(0, 1, 2), face(1, 2, 3)}}) ==
        "faces 0 and 1 both run from vertex 1 to vertex 2");
  CHECK(fault({{five.begin(), five.begin() + 3}, {face(0, 1, 2), face(1, 2, 0)}}) ==
        "faces 0 and 1 both run from vertex 0 to vertex 1");
  CHECK(fault({five, {face(0, 1, 2), face(2, 1, 3), face(1, 2, 4)}}) ==
        "faces 0 and 2 both run from vertex 1 to vertex 2");

  // Two triangles that share a corner and nothing else.
  CHECK(fault({five, {face(0, 1, 2), face(0, 3, 4)}}) ==
        "the faces at vertex 0 are several fans that only touch there");
}

// The greatest distance between two surfaces is found where no sample lies.

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
