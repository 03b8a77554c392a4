// SPDX-License-Identifier: GPL-3.0-or-later
// Soups of every kind become surfaces.
#include "mesh/error.hpp"
#include "soups.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using mesh::Model;
using mesh::RepairKind;
using mesh::Soup;
using test::repaired;
using test::soup;

namespace {

const std::vector<Vec3> tetra{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::vector<std::uint32_t>> tetra_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

/// The points of a box, bottom counterclockwise from above, then top.
std::vector<Vec3> box_points(Vec3 low, Vec3 high) {
  return {{low.x, low.y, low.z},  {high.x, low.y, low.z},  {high.x, high.y, low.z},  {low.x, high.y, low.z},
          {low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z}, {low.x, high.y, high.z}};
}
const std::vector<std::vector<std::uint32_t>> box_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::vector<std::vector<std::uint32_t>> shifted(std::vector<std::vector<std::uint32_t>> faces,
                                                std::uint32_t by) {
  for (auto& face : faces) {
    for (auto& v : face) {
      v += by;
    }
  }
  return faces;
}

template <class T>
std::vector<T> both(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_CASE("a tetrahedron of loose corners becomes closed", "[repair]") {
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

TEST_CASE("faces are turned to agree and outwards", "[repair]") {
  auto faces = tetra_faces;
  std::swap(faces[1][0], faces[1][1]);
  Model model = repaired(soup(tetra, faces));
  CHECK(test::volume(model.surface) == Approx(1.0 / 6));
  CHECK(model.repairs.count(RepairKind::faces_turned) == 1);
  for (auto& face : faces = tetra_faces) {
    std::swap(face[0], face[1]);
  }
  model = repaired(soup(tetra, faces));
  CHECK(test::volume(model.surface) == Approx(1.0 / 6));
  CHECK(model.repairs.count(RepairKind::components_turned) == 1);
  CHECK(model.repairs.count(RepairKind::faces_turned) == 0);
}

TEST_CASE("shells that share a point, an edge or nothing are each turned outwards", "[repair]") {
  const auto first = box_points({0, 0, 0}, {1, 1, 1});
  const Vec3 corner = GENERATE(Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{3, 3, 3});
  auto inverted = shifted(box_faces, 8);
  for (auto& face : inverted) {
    std::reverse(face.begin(), face.end());
  }
  const Model model =
      repaired(soup(both(first, box_points(corner, corner + Vec3{1, 1, 1})), both(box_faces, inverted)));
  CHECK(model.surface.vertex_count() == 16);
  CHECK(model.surface.component_count() == 2);
  CHECK(test::border_edges(model.surface) == 0);
  CHECK(test::volume(model.surface) == Approx(2.0));
  test::check_invariants(model.surface);
}

TEST_CASE("a cavity keeps facing inwards, and goes with its shell", "[repair]") {
  auto inner = shifted(box_faces, 8);
  for (auto& face : inner) {
    std::reverse(face.begin(), face.end());
  }
  auto faces = both(box_faces, inner);
  const auto points = both(box_points({0, 0, 0}, {3, 3, 3}), box_points({1, 1, 1}, {2, 2, 2}));
  Model model = repaired(soup(points, faces));
  CHECK(test::volume(model.surface) == Approx(26.0));
  CHECK(model.repairs.entries().empty());
  for (auto& face : faces) {
    std::reverse(face.begin(), face.end());
  }
  model = repaired(soup(points, faces));
  CHECK(test::volume(model.surface) == Approx(26.0));
  CHECK(model.repairs.count(RepairKind::components_turned) == 2);
}

TEST_CASE("a fin on an edge becomes a component of its own", "[repair]") {
  const Model model = repaired(soup(both(tetra, {{2, 2, 2}}), both(tetra_faces, {{0, 1, 4}})));
  CHECK(model.surface.component_count() == 2);
  CHECK(model.repairs.count(RepairKind::edges_split) == 1);
  CHECK(test::border_edges(model.surface) == 3);
  test::check_invariants(model.surface);
}

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

TEST_CASE("nearly equal points are joined along borders only", "[repair]") {
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

TEST_CASE("a far-off face doesn't join what lies near beside it", "[repair]") {
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

TEST_CASE("a heap of nearly equal points becomes one point", "[repair]") {
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

TEST_CASE("corners are found on edges of every length", "[repair]") {
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

TEST_CASE("a corner on a neighbour's side is set into it", "[repair]") {
  const Model model = repaired(soup({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}},
                                    {{0, 1, 2}, {0, 4, 3}, {3, 5, 1}}));
  CHECK(model.repairs.count(RepairKind::t_junctions_joined) == 1);
  CHECK(model.surface.component_count() == 1);
  CHECK(test::area(model.surface) == Approx(2.0));
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

TEST_CASE("many bodies, nested and beside each other, are turned outwards", "[repair]") {
  // Shells within shells: every other one is a cavity.
  const std::uint32_t nested = 6;
  const std::uint32_t beside = 500;
  Random random(8);
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  const auto add_box = [&](Vec3 low, Vec3 high, bool inverted) {
    auto box = shifted(box_faces, static_cast<std::uint32_t>(points.size()));
    for (auto& face : box) {
      if (inverted) {
        std::reverse(face.begin(), face.end());
      }
    }
    faces = both(faces, box);
    points = both(points, box_points(low, high));
  };
  double expected = 0.0;
  for (std::uint32_t i = 0; i < nested; ++i) {
    const double h = 10.0 - i;
    add_box({-h, -h, -h}, {h, h, h}, i % 2 == 1);
    expected += (i % 2 == 1 ? -8.0 : 8.0) * h * h * h;
  }
  for (std::uint32_t i = 0; i < beside; ++i) {
    const double x = 20.0 + 2.0 * i;
    const double size = 0.5 + random.unit();
    add_box({x, 0, 0}, {x + size, size, size}, i == 0 || random.below(2) == 0);
    expected += size * size * size;
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.surface.component_count() == nested + beside);
  CHECK(test::volume(model.surface) == Approx(expected));
}

TEST_CASE("a Moebius band is cut open once", "[repair]") {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  const std::uint32_t n = 12;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double t = 2.0 * 3.141592653589793 * i / n;
    for (const double s : {-0.3, 0.3}) {
      const double r = 1.0 + s * std::cos(t / 2);
      points.push_back({r * std::cos(t), r * std::sin(t), s * std::sin(t / 2)});
    }
    const std::uint32_t a = 2 * i;
    faces.push_back(i + 1 < n ? std::vector<std::uint32_t>{a, a + 2, a + 3, a + 1}
                              : std::vector<std::uint32_t>{a, 1, 0, a + 1});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.repairs.count(RepairKind::cut_open) == 1);
  CHECK(model.surface.component_count() == 1);
  CHECK(test::euler(model.surface) == 1);
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

TEST_CASE("a sound surface comes through as it is, however its faces are turned", "[repair]") {
  const mesh::Surface torus = test::revolve({{2, -0.5}, {2.5, 0}, {2, 0.5}, {1.5, 0}, {2, -0.5}}, 24);
  Soup s = test::soup_of(torus);
  Random random(3);
  for (std::size_t f = 0; f < s.polygon_count(); ++f) {
    if (random.below(2) == 0) {
      std::swap(s.corner_point[3 * f], s.corner_point[3 * f + 1]);
    }
  }
  const Model model = repaired(s);
  CHECK(model.surface.vertex_count() == torus.vertex_count());
  CHECK(test::euler(model.surface) == 0);
  CHECK(test::volume(model.surface) == Approx(test::volume(torus)));
}
