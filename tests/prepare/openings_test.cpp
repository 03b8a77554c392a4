// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies with openings: which ones are solid, and what is seen through them.
#include <algorithm>
#include <array>

#include "prepare/bodies.hpp"
#include "prepare/skin/skin.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;
using test::both;
using test::box;
using test::box_faces;
using test::box_points;
using test::Shape;
using test::shifted;
using test::soup;
using test::united;
using test::United;

TEST_CASE("bodies without a floor are capped, united and left open again", "[skin]") {
  auto no_floor = box_faces;
  no_floor.erase(no_floor.begin());
  Shape shape{box_points({0, 0, 0}, {2, 2, 2}), no_floor};
  SECTION("both on the ground") {
    shape.add({box_points({1, 1, 0}, {3, 3, 1}), no_floor});
    const United one = united(shape);
    CHECK(one.report.united == 2);
    CHECK(one.model.surface.component_count() == 1);
    // Open along the outline of both floors, and nowhere else.
    for (const EdgeId e : ids<EdgeId>(one.model.surface.edge_count())) {
      if (one.model.surface.is_border(e)) {
        const CornerId c = one.model.surface.sides(e)[0];
        CHECK(one.model.surface.point(one.model.surface.vertex(c)).z == 0.0);
        CHECK(one.model.surface.point(one.model.surface.vertex(mesh::next(c))).z == 0.0);
      }
    }
    const double top_and_walls = 4 + (16 - 2) + (4 - 1) + (8 - 2);
    CHECK(test::area(one.model.surface) == Approx(top_and_walls));
    CHECK(one.report.rims_closed == 0);
  }
  SECTION("one on top of the other") {
    shape.add({box_points({0.5, 0.5, 2}, {1, 1, 3}), no_floor});
    const United one = united(shape);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(test::area(one.model.surface) == Approx(4 + 16 + 2.0));
  }
  SECTION("one that reaches over the other's edge: it stays closed there") {
    shape.add({box_points({1, 0.5, 1.5}, {3, 1.5, 2.5}), no_floor});
    const United one = united(shape);
    CHECK(one.model.surface.component_count() == 1);
    CHECK(one.report.rims_closed == 1);
    CHECK(test::border_edges(one.model.surface) >= 4);
    for (const EdgeId e : ids<EdgeId>(one.model.surface.edge_count())) {
      if (one.model.surface.is_border(e)) {
        CHECK(one.model.surface.point(one.model.surface.vertex(one.model.surface.sides(e)[0])).z == 0.0);
      }
    }
  }
}

TEST_CASE("a beam at a wall that has neither back nor ends", "[skin]") {
  // Its opening is bent; its back is in the wall, so what closes it is right.
  Shape shape = box({0, 0, 0}, {4, 1, 4});
  const bool in_wall = GENERATE(true, false);
  const double back = in_wall ? 0.75 : 1.25;
  shape.add({{{1, 1.5, 1},
              {3, 1.5, 1},
              {3, 1.5, 1.5},
              {1, 1.5, 1.5},
              {1, back, 1},
              {3, back, 1},
              {3, back, 1.5},
              {1, back, 1.5}},
             {{1, 0, 3, 2}, {0, 1, 5, 4}, {2, 3, 7, 6}}});
  const United wall = united(shape);
  if (in_wall) {
    CHECK(wall.model.surface.component_count() == 1);
    CHECK(test::border_edges(wall.model.surface) == 0);
    CHECK(test::volume(wall.model.surface) == Approx(16 + 0.5));
    CHECK(wall.report.rims_closed > 0);
  } else {
    CHECK(wall.report.united == 0);
    CHECK(wall.model.surface.face_count() == 12 + 6);
  }
}

TEST_CASE("a bent leaf with a stem through it stays a sheet", "[skin]") {
  Shape shape = box({-0.1, -0.1, -1}, {0.1, 0.1, 1.5});
  shape.add({{{-1, -1, 0}, {0, -1, 0.4}, {1, -1, 0}, {1, 1, 0.2}, {0, 1, 0.6}, {-1, 1, 0.1}},
             {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}}});
  const United leaf = united(shape);
  double solid = 0.0;
  for (const FaceId f : ids<FaceId>(leaf.model.surface.face_count())) {
    solid += leaf.model.polygon[f] < 6 ? leaf.model.surface.area(f) : 0.0;
    CHECK(leaf.model.polygon[f] != mesh::Soup::none);
  }
  CHECK(solid == Approx(4 * 0.2 * 2.5 + 2 * 0.04));
  // What the stem goes through is a hole in the leaf now.
  CHECK(test::area(leaf.model.surface) < test::area(model_of_shape(shape).surface) - 0.04);
}

TEST_CASE("the brim of a hat stays, though what closes the hat lies on it", "[skin]") {
  auto no_floor = box_faces;
  no_floor.erase(no_floor.begin());
  Shape shape{both(box_points({0, 0, 0}, {2, 2, 2}), {{-1, -1, 0}, {3, -1, 0}, {3, 3, 0}, {-1, 3, 0}}),
              both(no_floor, {{8, 9, 1, 0}, {9, 10, 2, 1}, {10, 11, 3, 2}, {11, 8, 0, 3}})};
  REQUIRE(model_of_shape(shape).surface.component_count() == 1);
  shape.add(box({0.5, 0.5, 1.5}, {1, 1, 3}));
  const United hat = united(shape);
  CHECK(hat.report.united == 2);
  CHECK(hat.model.surface.component_count() == 1);
  const double brim = 16.0 - 4.0;
  CHECK(test::area(hat.model.surface) == Approx(4 + 16 + 2.0 + brim));
  CHECK(test::volume(hat.model.surface) == Approx(8 + 0.25));
  CHECK(hat.report.rims_closed == 0);
}

TEST_CASE("a strip that would be closed by itself for the most part stays a sheet", "[skin]") {
  Shape shape = box({0.4, -0.5, -1}, {0.6, 0.5, 1});
  // Three panels. Those at the ends are flat; the one between them is warped, and bent along the diagonal
  // over which it is larger.
  shape.add({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0.6}, {3, 0, 0.6}, {3, 1, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}},
             {{0, 1, 6}, {0, 6, 7}, {1, 2, 6}, {2, 5, 6}, {2, 3, 4}, {2, 4, 5}}});
  const double own = test::area(model_of_shape(shape).surface);
  const United strip = united(shape);
  CHECK(test::area(strip.model.surface) == Approx(own - 0.2 * 0.5));
  CHECK(strip.report.rims_closed == 0);
}

TEST_CASE("one can look into an open crate: what is in it stays", "[skin]") {
  auto no_lid = box_faces;
  no_lid.erase(no_lid.begin() + 1);
  Shape shape{box_points({0, 0, 0}, {2, 2, 2}), no_lid};
  shape.add(box({0.5, 0.5, 0.5}, {1.5, 1.5, 1}));
  const United crate = united(shape);
  CHECK(crate.report.united == 0);
  CHECK(crate.model.surface.face_count() == 22);
}

TEST_CASE("sheets end where solids begin, and solids aren't cut by them", "[skin]") {
  Shape shape = box({0, 0, 0}, {2, 2, 2});
  shape.add({{{1, 1, 1}, {4, 1, 1}, {4, 1, 1.5}, {1, 1, 1.5}}, {{0, 1, 2, 3}}});
  const United flag = united(shape);
  CHECK(flag.model.surface.component_count() == 2);
  CHECK(test::area(flag.model.surface) == Approx(24 + 1.0));
  // The box as it was, two faces of the flag that are left, and no more.
  CHECK(flag.model.surface.face_count() == 12 + 2 + 1);
}

TEST_CASE("what is behind sheets and can't be seen is left out", "[skin]") {
  // Six sheets around a leaf, each a little larger than the side of a box: none of them is closed, and they
  // have no edges in common. The lid is on the walls, or away from them.
  Shape shape;
  const double gap = GENERATE(0.0, 1.0);
  for (std::size_t i = 0; i < box_faces.size(); ++i) {
    Shape side;
    for (const std::uint32_t corner : box_faces[i]) {
      const Vec3 p = box_points({0, 0, 0}, {2, 2, 2})[corner];
      side.points.push_back(i < 2   ? Vec3{1.2 * p.x - 0.2, 1.2 * p.y - 0.2, p.z + (i == 1 ? gap : 0.0)}
                            : i % 2 ? Vec3{p.x, 1.2 * p.y - 0.2, 1.2 * p.z - 0.2}
                                    : Vec3{1.2 * p.x - 0.2, p.y, 1.2 * p.z - 0.2});
    }
    side.faces = {{0, 1, 2, 3}};
    shape.add(side);
  }
  shape.add({{{0.5, 0.5, 0.7}, {1.5, 0.5, 0.7}, {1.5, 1.5, 1.3}, {0.5, 1.5, 1.3}}, {{0, 1, 2, 3}}});
  const bool is_hidden = gap == 0.0;
  const United one = united(shape);
  CHECK(one.report.unseen == (is_hidden ? 1 : 0));
  CHECK(one.model.surface.face_count() == (is_hidden ? 12 : 14));
}

TEST_CASE("cavities that nobody can look into are dropped, with what is in them", "[skin]") {
  Shape shape = box({0, 0, 0}, {4, 4, 4});
  Shape cavity = box({1, 1, 1}, {3, 3, 3});
  for (auto& face : cavity.faces) {
    std::reverse(face.begin(), face.end());
  }
  shape.add(cavity);
  shape.add(box({1.5, 1.5, 1.5}, {2, 2, 2}));
  const United one = united(shape);
  CHECK(one.model.surface.face_count() == 12);
  CHECK(test::volume(one.model.surface) == Approx(64.0));
  CHECK(one.report.unseen == 2);
}

TEST_CASE("what closes an opening is called as the faces around it", "[skin]") {
  auto no_floor = box_faces;
  no_floor.erase(no_floor.begin());
  // The second box reaches over the edge of the first, so it gets a floor there.
  mesh::Soup named = soup(both(box_points({0, 0, 0}, {2, 2, 2}), box_points({1, 0.5, 1.5}, {3, 1.5, 2.5})),
                          both(no_floor, shifted(no_floor, 8)));
  named.objects = {{0, "house"}, {5, "balcony"}};
  Model model = mesh::repair(std::move(named), {}, Context());
  const prepare::SkinReport report = prepare::unite_bodies(model, Context());
  REQUIRE(report.rims_closed == 1);
  double floor = 0.0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    CHECK_FALSE(model.object_name(f).empty());
    if (model.surface.normal(f).z < -0.9) {
      CHECK(model.object_name(f) == "balcony");
      floor += model.surface.area(f);
    }
  }
  CHECK(floor == Approx(1.0));
}
