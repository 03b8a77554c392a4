// SPDX-License-Identifier: GPL-3.0-or-later
// Thin walls become sheets, and only these.
#include "prepare/bodies/thin_walls.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "mesh/mesh.hpp"
#include "prepare/common_models.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Skins;
using test::model_of;

namespace {

/// A cup of radius 40 and height 80 whose wall and bottom are so thick, closed around its rim.
mesh::Surface cup(double wall) {
  const double inside = 40.0 - wall;
  return test::revolve({{0.0, 0.0}, {40.0, 0.0}, {40.0, 80.0}, {inside, 80.0}, {inside, wall}, {0.0, wall}},
                       24);
}

/// A cutter for square cookies, 100 wide and 30 high: a wall 2 thick with a flange of 6 x 6 round its foot.
/// Its inner corners are sharp, its outer ones round, and the inner side has steps of 0.05, as models have
/// that were made of small cubes.
mesh::Surface cookie_cutter() {
  constexpr std::uint32_t to_a_side = 20;
  constexpr std::uint32_t round_a_corner = 8;
  std::vector<std::array<Vec3, 2>> ring;  // places of the inner side, and the way outwards from each
  for (std::uint32_t side = 0; side < 4; ++side) {
    const double turn = side * std::numbers::pi / 2.0;
    const Vec3 along{std::cos(turn), std::sin(turn), 0.0};
    const Vec3 out{std::sin(turn), -std::cos(turn), 0.0};
    for (std::uint32_t i = 0; i < to_a_side; ++i) {
      const double step = i % 2 == 0 ? 0.0 : 0.05;
      ring.push_back({50.0 * out + (4.9 * (i + 0.5) - 49.0) * along + step * out, out});
    }
    for (std::uint32_t i = 0; i < round_a_corner; ++i) {
      const double angle = (i + 0.5) / round_a_corner * std::numbers::pi / 2.0;
      const double left = 0.02 * (i - 3.5);
      ring.push_back({50.0 * out + 50.0 * along + (left < 0.0 ? left * along : -left * out),
                      std::cos(angle) * out + std::sin(angle) * along});
    }
  }
  // Round the wall: inner side up, the rim, outer side down to the flange, round this.
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  const auto size = static_cast<std::uint32_t>(ring.size());
  for (const auto& [p, out] : ring) {
    for (const Vec3 q :
         {p, p + Vec3{0.0, 0.0, 30.0}, p + 2.0 * out + Vec3{0.0, 0.0, 30.0},
          p + 2.0 * out + Vec3{0.0, 0.0, 6.0}, p + 6.0 * out + Vec3{0.0, 0.0, 6.0}, p + 6.0 * out}) {
      points.push_back(q);
    }
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t next = (i + 1) % size;
    for (std::uint32_t k = 0; k < 6; ++k) {
      const std::uint32_t above = (k + 1) % 6;
      faces.push_back({6 * i + k, 6 * i + above, 6 * next + above, 6 * next + k});
    }
  }
  return test::repaired(test::soup(std::move(points), faces)).surface;
}

/// The greatest distance of a point from the axis.
double radius(const mesh::Surface& surface) {
  double largest = 0.0;
  for (const Vec3 p : surface.points()) {
    largest = std::max(largest, std::hypot(p.x, p.y));
  }
  return largest;
}

}  // namespace

TEST_CASE("a thin cup keeps one skin, without its rim", "[sheets]") {
  mesh::Model model = model_of(cup(2.0));
  const double before = mesh::total_area(model.surface);
  const prepare::ThinWallReport report = prepare::merge_thin_walls(model, Skins::outer, 3.0, Context());
  CHECK(report.walls == 1);
  CHECK(report.thickness_mm == Approx(2.0).margin(0.05));
  CHECK(mesh::total_area(model.surface) < 0.55 * before);
  CHECK(model.surface.bounds().size().z == Approx(80.0));
  CHECK(radius(model.surface) == Approx(40.0));
  // One border: the outer edge of the rim.
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    border += model.surface.is_border(e) ? 1U : 0U;
  }
  CHECK(border == 24);
}

TEST_CASE("the sheet may lie in the middle of the wall", "[sheets]") {
  mesh::Model model = model_of(cup(2.0));
  CHECK(prepare::merge_thin_walls(model, Skins::middle, 3.0, Context()).walls == 1);
  CHECK(radius(model.surface) == Approx(39.0).margin(0.3));
}

TEST_CASE("thick walls, solids and what is asked to stay keep both skins", "[sheets]") {
  for (const auto& [wall, skins] : {std::pair{5.0, Skins::outer}, {2.0, Skins::both}}) {
    mesh::Model model = model_of(cup(wall));
    const std::size_t faces = model.surface.face_count();
    CHECK(prepare::merge_thin_walls(model, skins, 3.0, Context()).walls == 0);
    CHECK(model.surface.face_count() == faces);
  }
  // The walls of a house as small as a thumbnail are its whole body.
  mesh::Model tiny = model_of(cup(5.0));
  CHECK(prepare::merge_thin_walls(tiny, Skins::outer, 100.0, Context()).walls == 0);
  mesh::Model ball = model_of(test::scaled(test::sphere(16, 12), 40.0));
  CHECK(prepare::merge_thin_walls(ball, Skins::outer, 3.0, Context()).walls == 0);
}

TEST_CASE("how a cup stands and how large its unit is makes no difference", "[sheets]") {
  const mesh::Surface upright = cup(2.0);
  for (const double unit : {0.001, 1.0, 40.0}) {
    mesh::Model model = model_of(test::mapped(upright, [unit](Vec3 p) {
      return unit * Vec3{0.8 * p.x - 0.6 * p.z + 100.0, p.y, 0.6 * p.x + 0.8 * p.z};
    }));
    CHECK(prepare::merge_thin_walls(model, Skins::outer, 3.0 * unit, Context()).walls == 1);
    CHECK(mesh::total_area(model.surface) ==
          Approx(unit * unit * (40.0 * 40.0 * 3.106 + 80.0 * 250.6)).epsilon(0.01));
  }
}

TEST_CASE("a wall with round and sharp corners, steps and a flange keeps the skin that reaches everywhere",
          "[sheets]") {
  const mesh::Surface cutter = cookie_cutter();
  REQUIRE(test::border_edges(cutter) == 0);
  mesh::Model model = model_of(cutter);
  CHECK(prepare::merge_thin_walls(model, Skins::outer, 3.0, Context()).walls == 1);
  CHECK(model.surface.component_count() == 1);
  double above = 0.0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = model.surface.vertices(f);
    const double height =
        (model.surface.point(a).z + model.surface.point(b).z + model.surface.point(c).z) / 3.0;
    above += height > 10.0 ? model.surface.area(f) : 0.0;
  }
  // The inner side of the wall stays, and nothing else up there; the flange stays whole.
  CHECK(radius(model.surface) > 75.0);
  CHECK(above < 1.05 * 4.0 * 100.0 * 30.0);
  CHECK(mesh::total_area(model.surface) > 4.0 * (100.0 * 30.0 + 100.0 * (6.0 + 6.0 + 4.0)));
}
