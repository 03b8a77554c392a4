// SPDX-License-Identifier: GPL-3.0-or-later
// Thin walls become sheets, and only these.
#include "prepare/sheets/double_skins.hpp"

#include <cmath>
#include <numbers>

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
  const prepare::SheetsReport report = prepare::leave_one_skin(model, Skins::outer, 3.0, Context());
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
  CHECK(prepare::leave_one_skin(model, Skins::middle, 3.0, Context()).walls == 1);
  CHECK(radius(model.surface) == Approx(39.0).margin(0.3));
}

TEST_CASE("thick walls, solids and what is asked to stay keep both skins", "[sheets]") {
  for (const auto& [wall, skins] : {std::pair{5.0, Skins::outer}, {2.0, Skins::both}}) {
    mesh::Model model = model_of(cup(wall));
    const std::size_t faces = model.surface.face_count();
    CHECK(prepare::leave_one_skin(model, skins, 3.0, Context()).walls == 0);
    CHECK(model.surface.face_count() == faces);
  }
  // The walls of a house as small as a thumbnail are its whole body.
  mesh::Model tiny = model_of(cup(5.0));
  CHECK(prepare::leave_one_skin(tiny, Skins::outer, 100.0, Context()).walls == 0);
  mesh::Model ball = model_of(test::scaled(test::sphere(16, 12), 40.0));
  CHECK(prepare::leave_one_skin(ball, Skins::outer, 3.0, Context()).walls == 0);
}

TEST_CASE("how a cup stands and how large its unit is makes no difference", "[sheets]") {
  const mesh::Surface upright = cup(2.0);
  for (const double unit : {0.001, 1.0, 40.0}) {
    mesh::Model model = model_of(test::mapped(upright, [unit](Vec3 p) {
      return unit * Vec3{0.8 * p.x - 0.6 * p.z + 100.0, p.y, 0.6 * p.x + 0.8 * p.z};
    }));
    CHECK(prepare::leave_one_skin(model, Skins::outer, 3.0 * unit, Context()).walls == 1);
    CHECK(mesh::total_area(model.surface) ==
          Approx(unit * unit * (40.0 * 40.0 * 3.106 + 80.0 * 250.6)).epsilon(0.01));
  }
}
