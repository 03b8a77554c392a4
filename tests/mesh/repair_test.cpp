// SPDX-License-Identifier: GPL-3.0-or-later
// Soups of every kind become surfaces, from files and from memory.
#include <array>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/read_soup.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

// Soups of every kind become surfaces.

using namespace ridgecraft;
using mesh::Model;
using mesh::RepairKind;
using mesh::Soup;
using test::both;
using test::box_faces;
using test::box_points;
using test::repaired;
using test::soup;
using test::tetra;
using test::tetra_faces;

TEST_CASE("copies are dropped, a closed pillow is not", "[repair]") {
  Model model = repaired(soup(tetra, both(tetra_faces, {{1, 3, 0}, {3, 1, 0}})));
  CHECK(model.surface.face_count() == 4);
  CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == 2);
  model = repaired(soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}}));
  CHECK(model.surface.face_count() == 4);
  CHECK(test::border_edges(model.surface) == 0);
  CHECK(model.repairs.entries().empty());
  // Two-sided walls: one copy, all turned to one side.
  auto walls = box_faces;
  walls.pop_back();
  std::vector<std::vector<std::uint32_t>> sides;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    auto inside = walls[i];
    std::reverse(inside.begin(), inside.end());
    sides.push_back(i % 2 == 0 ? walls[i] : inside);
    sides.push_back(i % 2 == 0 ? inside : walls[i]);
  }
  model = repaired(soup(box_points({0, 0, 0}, {1, 1, 1}), sides));
  CHECK(model.surface.face_count() == 10);
  CHECK(model.surface.component_count() == 1);
  CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == 5);
  // Outwards: the normals point away from the middle.
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const Vec3 p = model.surface.point(model.surface.vertices(f)[0]) - Vec3{0.5, 0.5, 0.5};
    CHECK(dot(model.surface.normal(f), p) > 0.0);
  }
}

TEST_CASE("every face tells the polygon that it is part of", "[repair]") {
  Soup s = soup(both(box_points({0, 0, 0}, {1, 1, 1}), {{9, 9, 9}}), both({{0, 0, 1}}, box_faces));
  s.polygon_material.assign(7, Soup::none);
  s.polygon_material[3] = 0;
  s.materials.push_back({"red", {}, {}});
  const Model model = repaired(s);
  CHECK(model.polygon_count == 7);
  CHECK(model.repairs.count(RepairKind::polygons_dropped) == 1);
  CHECK(model.repairs.count(RepairKind::unused_points_dropped) == 1);
  REQUIRE(model.polygon.size() == 12);
  for (const FaceId f : ids<FaceId>(12)) {
    const std::uint32_t polygon = model.polygon[f];
    REQUIRE(polygon >= 1);
    for (const VertexId v : model.surface.vertices(f)) {
      const auto corners = s.polygon(polygon);
      CHECK(std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t c) { return s.points[c] == model.surface.point(v); }));
    }
    CHECK(model.material[f] == (polygon == 3 ? 0 : Soup::none));
  }
}

TEST_CASE("concave, collinear and large polygons are triangulated inside", "[repair]") {
  SECTION("a concave quad") {
    const Model model = repaired(soup({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}));
    CHECK(test::area(model.surface) == Approx(1.0));
  }
  SECTION("a triangle with a corner on its side") {
    const Model model = repaired(soup({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}));
    CHECK(model.surface.face_count() == 2);
    CHECK(test::area(model.surface) == Approx(2.0));
    CHECK(model.repairs.count(RepairKind::flat_faces_collapsed) == 0);
  }
  SECTION("a comb of many teeth, turned in space") {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> face;
    const int teeth = 300;
    const auto add = [&](double x, double y) {
      face.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({x, 0.6 * y, 0.8 * y});
    };
    add(0, -1);
    add(teeth, -1);
    for (int i = teeth; i-- > 0;) {
      add(i + 1, 5);
      add(i + 0.5, 5);
      add(i + 0.5, 0);
      add(i + 0.25, 0);
    }
    const Model model = repaired(soup(points, {face}));
    CHECK(model.surface.face_count() == face.size() - 2);
    // Base, teeth, and the small triangles beside them: by the shoelace formula.
    double expected = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 p = points[i];
      const Vec3 q = points[(i + 1) % points.size()];
      expected += 0.5 * (p.x * q.y - q.x * p.y) / 0.6;
    }
    CHECK(test::area(model.surface) == Approx(expected));
  }
  SECTION("a frame whose outline goes to the hole over a bridge") {
    const Model model = repaired(
        soup({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}},
             {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}));
    CHECK(test::area(model.surface) == Approx(8.0));
    CHECK(test::border_edges(model.surface) == 8);
  }
  SECTION("a bow tie is left out") {
    const Model model = repaired(
        soup(both(tetra, {{5, 0, 0}, {6, 1, 0}, {6, 0, 0}, {5, 1, 0}}), both(tetra_faces, {{4, 5, 6, 7}})));
    CHECK(model.surface.face_count() == 4);
    CHECK(model.repairs.count(RepairKind::crossed_polygons_rebuilt) == 1);
  }
}

TEST_CASE("faces without area go or stay as asked, and nothing opens", "[repair]") {
  // A tetrahedron with a point set into an edge on one side only, and a flat face that fills the gap.
  const auto points = both(tetra, {{0.5, 0, 0}});
  const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 4}, {4, 2, 1}, {0, 1, 3},
                                                      {1, 2, 3}, {0, 3, 2}, {0, 4, 1}};
  const Model gone = repaired(soup(points, faces));
  CHECK(gone.repairs.count(RepairKind::flat_faces_collapsed) == 1);
  CHECK(test::border_edges(gone.surface) == 0);
  CHECK(test::volume(gone.surface) == Approx(1.0 / 6));
  const Model kept = repaired(soup(points, faces), false);
  CHECK(kept.surface.face_count() == 6);
  CHECK(test::border_edges(kept.surface) == 0);
  test::check_invariants(gone.surface);
  test::check_invariants(kept.surface);
}

TEST_CASE("flat faces and a fan on one edge don't multiply", "[repair]") {
  const std::uint32_t n = 300;
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double t = 3.0 * i / n;
    points.push_back({(i + 1.0) / (n + 1.0), 0, 0});
    points.push_back({0.5, std::cos(t), std::sin(t)});
    faces.push_back({0, 1, 2 * i + 2});
    faces.push_back({1, 0, 2 * i + 3});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.surface.face_count() >= n);
  CHECK(model.surface.face_count() <= 8 * n);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    REQUIRE(model.surface.area(f) > 1e-9);
  }
  test::check_invariants(model.surface);
}

TEST_CASE("coordinates survive bit for bit, extreme ones up to a power of two", "[repair]") {
  const Model model = repaired(soup({{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.7, 0.3}}, {{0, 1, 2}}));
  CHECK(model.surface.point(VertexId(0)) == Vec3{0.1, 0.2, 0.3});
  CHECK(model.file_scale == 1.0);
  for (const double huge : {1e300, 1e-300, 5e-324}) {
    const Model far = repaired(soup({{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}}, {{0, 1, 2}}));
    CHECK(far.surface.point(VertexId(1)).x * far.file_scale == huge);
    CHECK(std::isnormal(far.surface.area(FaceId(0))));
  }
}

TEST_CASE("what has no area anywhere is refused", "[repair]") {
  CHECK_THROWS_AS(repaired(soup({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}})), Error);
  CHECK_THROWS_AS(repaired(soup({{0, 0, 0}}, {{0, 0, 0}})), Error);
  CHECK_THROWS_AS(repaired(soup({{1e200, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 2, 3}})),
                  Error);
}

TEST_CASE("random soups become surfaces", "[repair]") {
  Random random(20);
  for (int round = 0; round < 1500; ++round) {
    const std::uint32_t n = 4 + random.below(7);
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < n; ++i) {
      // Few different coordinates: equal points, flat faces, points on edges.
      points.push_back({double(random.below(3)), double(random.below(3)), double(random.below(2))});
    }
    std::vector<std::vector<std::uint32_t>> faces;
    const std::uint32_t count = 1 + random.below(30);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::vector<std::uint32_t> face;
      const std::uint32_t corners = random.below(8) == 0 ? random.below(7) : 3;
      for (std::uint32_t k = 0; k < corners; ++k) {
        face.push_back(random.below(n));
      }
      faces.push_back(face);
    }
    INFO("round " << round);
    const Soup s = soup(points, faces);
    for (const bool collapse : {true, false}) {
      try {
        const Model model = repaired(s, collapse);
        test::check_invariants(model.surface);
        REQUIRE(model.polygon.size() == model.surface.face_count());
        for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
          REQUIRE(model.polygon[f] < count);
          if (collapse) {
            REQUIRE(model.surface.area(f) > 1e-6);
          }
        }
        // Repairing once more changes nothing but what a cut left for equal points to join again.
        if (model.surface.face_count() < 4) {
          continue;
        }
      } catch (const Error& error) {
        REQUIRE(error.kind() == ErrorKind::unusable_mesh);
      }
    }
  }
}

// Points that are one are joined, and nothing else.

TEST_CASE("a tetrahedron of loose corners becomes closed", "[weld]") {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto& face : tetra_faces) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const std::uint32_t v : face) {
      points.push_back(tetra[v]);
    }
    faces.push_back({first, first + 1, first + 2});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.surface.vertex_count() == 4);
  CHECK(test::border_edges(model.surface) == 0);
  CHECK(test::volume(model.surface) == Approx(1.0 / 6));
  CHECK(model.repairs.count(RepairKind::points_joined) == 8);
}

TEST_CASE("nearly equal points are joined along borders only", "[weld]") {
  const double e = 1e-7;
  SECTION("a seam closes") {
    const Model model = repaired(
        soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, e}, {1, 1, 0}, {0, 1, -e}}, {{0, 1, 2}, {3, 4, 5}}));
    CHECK(model.surface.vertex_count() == 4);
    CHECK(model.repairs.count(RepairKind::border_points_joined) == 2);
  }
  SECTION("an edge keeps its two ends") {
    const Model model = repaired(soup({{0, 0, 0}, {e, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), false);
    CHECK(model.surface.vertex_count() == 3);
    CHECK(model.repairs.count(RepairKind::border_points_joined) == 0);
  }
}

TEST_CASE("a far-off face doesn't join what lies near beside it", "[weld]") {
  // A millionth of the diagonal is larger than all other faces together.
  Random random(5);
  std::vector<Vec3> points{{1e7, 0, 0}, {1e7, 1, 0}, {1e7, 0, 1e6}};
  std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}};
  const auto somewhere = [&] { return Vec3{random.unit(), random.unit(), random.unit()}; };
  const std::uint32_t n = 300;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 middle = somewhere();
    faces.push_back({3 * i + 3, 3 * i + 4, 3 * i + 5});
    for (int k = 0; k < 3; ++k) {
      points.push_back(middle + 0.01 * somewhere());
    }
  }
  const Model model = repaired(soup(points, faces), false);
  CHECK(model.repairs.count(RepairKind::border_points_joined) == 0);
  CHECK(model.repairs.count(RepairKind::t_junctions_joined) == 0);
  CHECK(model.surface.component_count() == n + 1);
}

TEST_CASE("a heap of nearly equal points becomes one point", "[weld]") {
  // Every triangle of a fan has a middle of its own: many more than one point's companions in one round.
  const std::uint32_t n = 2000;
  Random random(6);
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double t = 2.0 * 3.141592653589793 * i / n;
    points.push_back({std::cos(t), std::sin(t), 0.0});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    faces.push_back({i, (i + 1) % n, n + i});
    points.push_back(1e-6 * Vec3{random.unit(), random.unit(), random.unit()});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.repairs.count(RepairKind::border_points_joined) == n - 1);
  CHECK(model.surface.vertex_count() == n + 1);
  CHECK(test::border_edges(model.surface) == n);
}

TEST_CASE("corners are found on edges of every length", "[weld]") {
  // One side of a triangle far longer than the mean border edge, with small neighbours along it.
  const std::uint32_t n = 400;
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}};
  Random random(7);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double from = i == 0 ? 0.0 : i / double(n);
    const double to = i + 1 == n ? 1.0 : (i + 1) / double(n);
    faces.push_back({3 * i + 4, 3 * i + 3, 3 * i + 5});
    points.push_back({from, i == 0 ? 0.0 : 1e-7 * (random.unit() - 0.5), 0});
    points.push_back({to, i + 1 == n ? 0.0 : 1e-7 * (random.unit() - 0.5), 0});
    points.push_back({0.5 * (from + to), -0.001, 0});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.repairs.count(RepairKind::t_junctions_joined) == n - 1);
  CHECK(model.surface.component_count() == 1);
  CHECK(test::border_edges(model.surface) == 2 * n + 2);
}

TEST_CASE("a corner on a neighbour's side is set into it", "[weld]") {
  const Model model = repaired(soup({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}},
                                    {{0, 1, 2}, {0, 4, 3}, {3, 5, 1}}));
  CHECK(model.repairs.count(RepairKind::t_junctions_joined) == 1);
  CHECK(model.surface.component_count() == 1);
  CHECK(test::area(model.surface) == Approx(2.0));
}

// Points and polygons in memory become the model that a file of them would.

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

TEST_CASE("repair: of faces that are there twice the copy that looks outwards gives the colour") {
  // A box whose sides were drawn from both sides, the two copies in any order: front orange, back blue.
  const std::vector<std::vector<std::uint32_t>> sides{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::string obj =
      "mtllib none\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\nv 4 3 2\nv 0 3 2\nvt 0 0\nvt 1 0\n"
      "vt 1 1\nvt 0 1\nvt 0.5 0.5\n";
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (const bool back : {i % 2 == 0, i % 2 != 0}) {
      obj += back ? "usemtl back\nf" : "usemtl front\nf";
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t corner = back ? 3 - k : k;
        obj += " " + std::to_string(sides[i][corner] + 1) + "/" + std::to_string(back ? 5 : corner + 1);
      }
      obj += "\n";
    }
  }
  const mesh::Model model =
      mesh::read(mesh::ModelFile{.bytes = obj, .name = "box.obj", .title = "box", .folder = {}}, {}, {});
  REQUIRE(model.surface.face_count() == 12);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    CHECK(model.materials.at(model.material[f]).name == "front");
    CHECK(model.texture[f][0] != Vec2{0.5, 0.5});
    CHECK(model.texture[f][0] != model.texture[f][1]);
  }
}

TEST_CASE("repair: star polygons are what they run around, and stars that share sides close") {
  // A pentagram with corners on a circle: its area is that of ten triangles around the middle.
  std::vector<Vec3> points;
  for (int k = 0; k < 5; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 5.0;
    points.push_back({elementary::cos(angle), elementary::sin(angle), 0.0});
  }
  const std::vector<std::vector<std::uint32_t>> star{{0, 2, 4, 1, 3}};
  const mesh::Model model = mesh::repair(points, star, {}, {});
  double area = 0.0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    area += model.surface.area(f);
  }
  CHECK(area == Approx(1.12256994));
  CHECK(model.surface.vertex_count() == 11);
  CHECK(model.repairs.count(RepairKind::crossed_polygons_rebuilt) == 1);
  // Turned around it is the same.
  const mesh::Model turned =
      mesh::repair(points, std::vector<std::vector<std::uint32_t>>{{3, 1, 4, 2, 0}}, {}, {});
  CHECK(turned.surface.vertex_count() == 11);
}
