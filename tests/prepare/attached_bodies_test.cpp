// SPDX-License-Identifier: GPL-3.0-or-later
// What rises from a flat face is parted from it, and only that.
#include "prepare/bodies/attached_bodies.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/mesh.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/at_size.hpp"
#include "prepare/layers.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using test::border_edges;
using test::layers;

namespace {

using StackCells = std::vector<std::array<int, 3>>;

/// A plate of cells, and on it the cells that are given, of height 1 each from level 1 on. A cell is 4 mm
/// wide.
StackCells on_plate(int wide, const StackCells& on_it) {
  StackCells cells = on_it;
  for (int x = 0; x < wide; ++x) {
    for (int y = 0; y < wide; ++y) {
      cells.push_back({x, y, 0});
    }
  }
  return cells;
}

mesh::Model stack(const StackCells& cells) {
  return layers(cells, {0.0, 10.0, 30.0, 40.0});
}

/// The area of a closed surface, and that of all that is open in it, twice: below what stands there and on
/// it.
double area_with_openings(const mesh::Surface& surface) {
  double area = mesh::total_area(surface);
  for (const mesh::Opening& opening : mesh::flat_openings(surface, 0.01)) {
    for (const auto& [a, b, c] : mesh::triangles_of(surface, opening)) {
      area -= 0.5 * length(cross(b - a, c - a));
    }
  }
  return area;
}

std::size_t parted(mesh::Model& model) {
  const double area = mesh::total_area(model.surface);
  const std::size_t before = model.surface.component_count();
  const std::size_t attached = prepare::part_attached_bodies(model, Context());
  CHECK(model.surface.component_count() == before + attached);
  test::check_invariants(model.surface);
  // What is added is what the openings lack.
  CHECK(area_with_openings(model.surface) == Approx(area));
  return attached;
}

}  // namespace

TEST_CASE("a tower on a plate is parted from it, and the plate is whole below it", "[attached]") {
  mesh::Model model = stack(on_plate(6, {{2, 2, 1}, {3, 2, 1}, {2, 3, 1}, {3, 3, 1}}));
  CHECK(parted(model) == 1);
  CHECK(border_edges(model.surface) > 0);
  const std::vector<mesh::Opening> bases = mesh::flat_openings(model.surface, 0.01);
  REQUIRE(bases.size() == 1);
  CHECK(bases.front().middle.z == Approx(10.0));
  CHECK(bases.front().normal.z == Approx(-1.0));
  // Nothing is left to be done.
  CHECK(prepare::part_attached_bodies(model, Context()) == 0);
}

TEST_CASE("what stands at the edge of a face, in a corner or in a hollow isn't parted", "[attached]") {
  SECTION("flush with a side") {
    mesh::Model model = stack(on_plate(4, {{0, 1, 1}, {0, 2, 1}, {1, 1, 1}, {1, 2, 1}}));
    CHECK(parted(model) == 0);
  }
  SECTION("a hole") {
    StackCells ring;
    for (int x = 0; x < 6; ++x) {
      for (int y = 0; y < 6; ++y) {
        if (x < 2 || x > 3 || y < 2 || y > 3) {
          ring.push_back({x, y, 1});
        }
      }
    }
    mesh::Model model = stack(on_plate(6, ring));
    CHECK(parted(model) == 0);
  }
  SECTION("a well, whose floor is the face") {
    StackCells well;
    for (int x = 2; x < 6; ++x) {
      for (int y = 2; y < 6; ++y) {
        if (x == 2 || x == 5 || y == 2 || y == 5) {
          well.push_back({x, y, 1});
        }
      }
    }
    mesh::Model model = stack(on_plate(8, well));
    CHECK(parted(model) == 0);
  }
  SECTION("a foot of 2 x 2 mm") {
    mesh::Model model = stack(on_plate(5, {{2, 2, 1}}));
    prepare::SizeOptions small;
    small.largest_extent_mm = 10.0;
    prepare::resize(model, small);
    CHECK(parted(model) == 0);
  }
}

TEST_CASE("an arch that stands on two bases is one body", "[attached]") {
  mesh::Model model =
      stack(on_plate(10, {{2, 4, 1}, {2, 5, 1}, {3, 4, 1}, {3, 5, 1}, {6, 4, 1}, {6, 5, 1}, {7, 4, 1},
                          {7, 5, 1}, {2, 4, 2}, {3, 4, 2}, {4, 4, 2}, {5, 4, 2}, {6, 4, 2}, {7, 4, 2},
                          {2, 5, 2}, {3, 5, 2}, {4, 5, 2}, {5, 5, 2}, {6, 5, 2}, {7, 5, 2}}));
  CHECK(parted(model) == 1);
  CHECK(mesh::flat_openings(model.surface, 0.01).size() == 2);
}

TEST_CASE("no more bodies are parted than can be kept apart, and of equal ones all or none", "[attached]") {
  StackCells towers;
  const auto tower = [&](int x, int y, int wide) {
    for (int i = 0; i < wide; ++i) {
      for (int k = 0; k < wide; ++k) {
        towers.push_back({x + i, y + k, 1});
      }
    }
  };
  for (int i = 0; i < 4; ++i) {
    tower(1 + 5 * i, 1, 3);
  }
  SECTION("four") {
    mesh::Model model = stack(on_plate(24, towers));
    CHECK(parted(model) == 4);
  }
  SECTION("four large ones and six small ones") {
    for (int i = 0; i < 6; ++i) {
      tower(1 + 3 * i, 8, 2);
    }
    mesh::Model model = stack(on_plate(24, towers));
    CHECK(parted(model) == 6);
  }
}

TEST_CASE("how a model stands makes no difference to what is parted", "[attached]") {
  const StackCells cells = on_plate(6, {{2, 2, 1}, {3, 2, 1}, {2, 3, 1}, {3, 3, 1}});
  for (const double angle : {0.3, 1.1}) {
    mesh::Model model = layers(cells, {0.0, 10.0, 30.0, 40.0}, [angle](Vec3 p) {
      return Vec3{std::cos(angle) * p.x - std::sin(angle) * p.z, p.y,
                  std::sin(angle) * p.x + std::cos(angle) * p.z};
    });
    CHECK(parted(model) == 1);
  }
}
