// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of others are taken for a surface, and what is said of those that aren't.
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using mesh::Surface;

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
