// SPDX-License-Identifier: GPL-3.0-or-later
// Points and polygons in memory become the model that a file of them would.
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/read_soup.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using mesh::RepairKind;
using test::box_faces;
using test::box_points;
using test::tetra;

namespace {

using Polygons = std::vector<std::vector<std::uint32_t>>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Model repaired_polygons(const std::vector<Vec3>& points, const Polygons& polygons) {
  return mesh::repair(points, polygons, {}, {});
}

std::string triangles_refusal(const std::vector<Vec3>& points, const Triangles& triangles) {
  try {
    (void)mesh::repair(points, triangles, {}, {});
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::unusable_mesh);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("polygons in memory become what their file becomes", "[repair]") {
  int models = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(RIDGECRAFT_SOURCE_DIR) / "samples")) {
    if (entry.path().extension() != ".obj" && entry.path().extension() != ".off") {
      continue;
    }
    INFO(entry.path());
    ++models;
    const Model of_file = mesh::read(entry.path(), {}, {});
    const mesh::Soup soup = mesh::read_soup(entry.path(), {});
    Polygons polygons;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
      polygons.emplace_back(soup.polygon(i).begin(), soup.polygon(i).end());
    }
    const Model in_memory = repaired_polygons(soup.points, polygons);
    CHECK(in_memory.polygon == of_file.polygon);
    CHECK(in_memory.polygon_count == of_file.polygon_count);
    REQUIRE(in_memory.surface.face_count() == of_file.surface.face_count());
    for (const FaceId f : ids<FaceId>(of_file.surface.face_count())) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto point_of = [&](const mesh::Surface& s) { return s.point(s.vertex(mesh::corner(f, k))); };
        CHECK(point_of(in_memory.surface) == point_of(of_file.surface));
      }
    }
  }
  CHECK(models > 5);
}

TEST_CASE("broken polygons in memory are repaired and counted", "[repair]") {
  // A cube with a wall that faces inwards, another given twice, and a point that nobody uses.
  std::vector<Vec3> points = box_points({0, 0, 0}, {1, 1, 1});
  points.push_back({5, 5, 5});
  Polygons polygons = box_faces;
  std::reverse(polygons[2].begin(), polygons[2].end());
  polygons.push_back(polygons[4]);
  const Model model = repaired_polygons(points, polygons);
  test::check_invariants(model.surface);
  CHECK(model.surface.face_count() == 12);
  CHECK(test::border_edges(model.surface) == 0);
  CHECK(model.repairs.count(RepairKind::unused_points_dropped) == 1);
  CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == 1);
  CHECK(model.polygon_count == 7);
}

TEST_CASE("the digest of a model in memory is that of its numbers", "[repair]") {
  const std::vector<Vec3> points = box_points({0, 0, 0}, {1, 1, 1});
  const std::string digest = repaired_polygons(points, box_faces).digest;
  CHECK(digest.size() == 16);
  CHECK(repaired_polygons(points, box_faces).digest == digest);
  CHECK(repaired_polygons(box_points({0, 0, 0}, {1, 1, 2}), box_faces).digest != digest);
  Polygons turned = box_faces;
  std::rotate(turned[0].begin(), turned[0].begin() + 1, turned[0].end());
  CHECK(repaired_polygons(points, turned).digest != digest);
}

TEST_CASE("triangles in memory that mean nothing are refused in one sentence", "[repair]") {
  CHECK(triangles_refusal(tetra, {{0, 1, 2}, {0, 1, 4}}) == "polygon 1 names point 4, and there are 4");
  std::vector<Vec3> points = tetra;
  points[2].y = std::numeric_limits<double>::quiet_NaN();
  CHECK(triangles_refusal(points, {{0, 1, 2}}) == "point 2 has a coordinate that is no finite number");
  CHECK(triangles_refusal(tetra, {}) == "there are no faces");
  CHECK(triangles_refusal({}, {}) == "there are no faces");
  CHECK(triangles_refusal(tetra, {{0, 1, 1}}) == "no face has an area");
}
