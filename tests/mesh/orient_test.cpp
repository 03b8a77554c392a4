// SPDX-License-Identifier: GPL-3.0-or-later
// Faces are turned to agree and outwards; what no surface can be is cut open.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/boxes.hpp"
#include "base/context.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "mesh/repair/self_intersections.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using mesh::RepairKind;
using mesh::Soup;
using test::both;
using test::box_faces;
using test::box_points;
using test::repaired;
using test::shifted;
using test::soup;
using test::tetra;
using test::tetra_faces;

TEST_CASE("faces are turned to agree and outwards", "[orient]") {
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

TEST_CASE("shells that share a point, an edge or nothing are each turned outwards", "[orient]") {
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

TEST_CASE("a cavity keeps facing inwards, and goes with its shell", "[orient]") {
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

TEST_CASE("a fin on an edge becomes a component of its own", "[orient]") {
  const Model model = repaired(soup(both(tetra, {{2, 2, 2}}), both(tetra_faces, {{0, 1, 4}})));
  CHECK(model.surface.component_count() == 2);
  CHECK(model.repairs.count(RepairKind::edges_split) == 1);
  CHECK(test::border_edges(model.surface) == 3);
  test::check_invariants(model.surface);
}

TEST_CASE("many bodies, nested and beside each other, are turned outwards", "[orient]") {
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

TEST_CASE("a Moebius band is cut open once", "[orient]") {
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

TEST_CASE("a sound surface comes through as it is, however its faces are turned", "[orient]") {
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

TEST_CASE("two cubes that share a face from both sides are one box", "[orient]") {
  const bool with_sheet = GENERATE(false, true);
  auto faces = both(box_faces, shifted(box_faces, 8));
  auto points = both(box_points({0, 0, 0}, {1, 1, 1}), box_points({1, 0, 0}, {2, 1, 1}));
  if (with_sheet) {
    // A doubled sheet that hangs on the wall's edge stays one sheet.
    points = both(points, {{1, -1, 0}, {1, -1, 1}});
    faces = both(faces, {{1, 5, 17, 16}, {16, 17, 5, 1}});
  }
  const Model model = repaired(soup(points, faces));
  CHECK(model.repairs.count(RepairKind::inner_walls_dropped) == 1);
  CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == (with_sheet ? 1 : 0));
  CHECK(model.surface.component_count() == (with_sheet ? 2 : 1));
  CHECK(test::border_edges(model.surface) == (with_sheet ? 4 : 0));
  CHECK(test::area(model.surface) == Approx(with_sheet ? 11.0 : 10.0));
  test::check_invariants(model.surface);
}

TEST_CASE("a heap of cubes loses all walls between them", "[orient]") {
  // Any set of cubes of a grid: what is left is their outside, and its volume their number.
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    INFO("round " << round);
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    std::set<std::array<int, 3>> cubes;
    const std::uint32_t share = round == 0 ? 1 : 1 + random.below(3);
    for (int i = 0; i < 27; ++i) {
      if (random.below(share) == 0) {
        cubes.insert({i % 3, i / 3 % 3, i / 9});
      }
    }
    if (cubes.empty()) {
      continue;
    }
    std::size_t outer = 0;
    std::size_t inner = 0;
    for (const auto& [x, y, z] : cubes) {
      faces = both(faces, shifted(box_faces, static_cast<std::uint32_t>(points.size())));
      points =
          both(points, box_points(Vec3{double(x), double(y), double(z)}, Vec3{x + 1.0, y + 1.0, z + 1.0}));
      for (const auto& [i, j, k] : std::vector<std::array<int, 3>>{
               {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
        (cubes.contains({x + i, y + j, z + k}) ? inner : outer) += 1;
      }
    }
    const Model model = repaired(soup(points, faces));
    CHECK(model.repairs.count(RepairKind::inner_walls_dropped) == inner / 2);
    CHECK(test::area(model.surface) == Approx(double(outer)));
    CHECK(test::volume(model.surface) == Approx(double(cubes.size())));
    CHECK(test::border_edges(model.surface) == 0);
    test::check_invariants(model.surface);
  }
}

TEST_CASE("walls drawn from both sides stay one sheet", "[orient]") {
  SECTION("a partition that ends in the open") {
    // A box without its lid, divided by a wall that is there from both sides.
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {0, 1, 1}};
    const Model model = repaired(soup(points, {{0, 5, 4, 1},
                                               {1, 4, 3, 2},
                                               {0, 1, 7, 6},
                                               {1, 2, 8, 7},
                                               {2, 3, 9, 8},
                                               {3, 4, 10, 9},
                                               {4, 5, 11, 10},
                                               {5, 0, 6, 11},
                                               {1, 4, 10, 7},
                                               {7, 10, 4, 1}}));
    CHECK(model.repairs.count(RepairKind::inner_walls_dropped) == 0);
    CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == 1);
    CHECK(test::area(model.surface) == Approx(9.0));
    // Box and partition: the box isn't cut open where the partition stands on it.
    CHECK(model.surface.component_count() == 2);
    CHECK(model.repairs.count(RepairKind::edges_split) == 3);
    CHECK(test::border_edges(model.surface) == 6 + 4);
  }
  SECTION("a whole box, touching another one") {
    auto inside_out = box_faces;
    for (auto& face : inside_out) {
      std::reverse(face.begin(), face.end());
    }
    const Model model =
        repaired(soup(both(box_points({0, 0, 0}, {1, 1, 1}), box_points({1, 1, 0}, {2, 2, 1})),
                      both(both(box_faces, inside_out), shifted(box_faces, 8))));
    CHECK(model.repairs.count(RepairKind::inner_walls_dropped) == 0);
    CHECK(model.repairs.count(RepairKind::duplicate_faces_dropped) == 6);
    CHECK(model.surface.component_count() == 2);
    CHECK(test::volume(model.surface) == Approx(2.0));
  }
}

TEST_CASE("of three sheets at an edge the two that are folded least stay joined", "[orient]") {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1},   {0, 0, 1},
                                 {0, 1, 0}, {1, 1, 0}, {0, -1, .2}, {1, -1, .2}};
  const Model model = repaired(soup(points, {{0, 1, 2, 3}, {0, 1, 5, 4}, {0, 1, 7, 6}}));
  CHECK(model.surface.component_count() == 2);
  CHECK(model.repairs.count(RepairKind::edges_split) == 1);
  // The two that are nearly one plane.
  CHECK(model.surface.component(FaceId(0)) != model.surface.component(FaceId(2)));
  CHECK(model.surface.component(FaceId(2)) == model.surface.component(FaceId(4)));
  test::check_invariants(model.surface);
}

namespace ridgecraft::mesh {
namespace {

// Faces that run through each other, and the boxes by which near pairs are found, against all pairs.

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs found_pairs(const std::vector<Box3>& boxes) {
  Pairs pairs;
  NearBoxes(boxes).for_pairs(
      [&](std::uint32_t i, std::uint32_t j) { pairs.emplace_back(std::min(i, j), std::max(i, j)); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs touching_pairs(const std::vector<Box3>& boxes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const Box3& a = boxes[i];
      const Box3& b = boxes[j];
      if (a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
          a.low.z <= b.high.z && b.low.z <= a.high.z) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

/// Boxes of many sizes, on a coarse grid so that many touch exactly.
std::vector<Box3> some_boxes(std::uint64_t seed, std::size_t count, double grid, Vec3 far_off) {
  Random random(seed);
  const auto coordinate = [&](double size) { return std::floor(random.unit() * size) * grid; };
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    const double extent = random.below(20) == 0 ? 40.0 : 3.0;
    const Vec3 low = far_off + Vec3{coordinate(100.0), coordinate(100.0), coordinate(100.0)};
    box.add(low);
    box.add(low + Vec3{coordinate(extent), coordinate(extent), coordinate(extent)});
  }
  return boxes;
}

/// Two tetrahedra, the second moved.
Surface two_tetrahedra(Vec3 by) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Vec3 move : {Vec3{}, by}) {
    const auto n = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      points.push_back(p + move);
    }
    for (const auto& [a, b, c] :
         {std::array{0U, 2U, 1U}, std::array{0U, 1U, 3U}, std::array{1U, 2U, 3U}, std::array{2U, 0U, 3U}}) {
      faces.push_back({VertexId(n + a), VertexId(n + b), VertexId(n + c)});
    }
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("all pairs of boxes that touch are found, each once", "[mesh]") {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 9U, 300U}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const std::vector<Box3> boxes = some_boxes(seed, count, 0.125, {});
      CHECK(found_pairs(boxes) == touching_pairs(boxes));
    }
  }
}

TEST_CASE("no pair of boxes is lost to single precision", "[mesh]") {
  const std::vector<Box3> boxes = some_boxes(7, 300, 0.1, {1e9, -3e7, 12.3});
  const Pairs found = found_pairs(boxes);
  const Pairs touching = touching_pairs(boxes);
  CHECK(std::includes(found.begin(), found.end(), touching.begin(), touching.end()));
  CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
}

TEST_CASE("faces that run through each other are counted", "[mesh]") {
  CHECK(count_self_intersections(two_tetrahedra({2.0, 0.0, 0.0}), {}) == 0);
  // Along the diagonal: the slanted face of the first one runs through the three others of the second.
  CHECK(count_self_intersections(two_tetrahedra({0.2, 0.2, 0.2}), {}) == 3);
  // They touch at one corner only, which is a corner of both.
  CHECK(count_self_intersections(two_tetrahedra({1.0, 0.0, 0.0}), {}) == 0);
  // A corner of one lies within a face of the other.
  CHECK(count_self_intersections(two_tetrahedra({0.25, 0.25, 0.5}), {}) > 0);
}

TEST_CASE("counting faces that run through each other can be stopped", "[mesh]") {
  // Large triangles anywhere: most pairs of them meet.
  Random random(3);
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (std::uint32_t f = 0; f < 1000; ++f) {
    for (int k = 0; k < 3; ++k) {
      points.push_back({random.unit(), random.unit(), random.unit()});
    }
    faces.push_back({VertexId(3 * f), VertexId(3 * f + 1), VertexId(3 * f + 2)});
  }
  StopSource stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  CHECK_THROWS_AS(count_self_intersections(Surface(std::move(points), std::move(faces)), context), Error);
}

}  // namespace ridgecraft::mesh
