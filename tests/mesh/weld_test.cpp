// SPDX-License-Identifier: GPL-3.0-or-later
// Points that are one are joined, and nothing else.
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using mesh::RepairKind;
using test::repaired;
using test::soup;
using test::tetra;
using test::tetra_faces;

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
