// SPDX-License-Identifier: GPL-3.0-or-later
// Battlements go where they are what a model consists of, and steps stay.
#include "prepare/features/trim_teeth.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/layers.hpp"
#include "prepare/ready_bodies.hpp"

using namespace ridgecraft;
using test::flipped;
using test::layers;
using test::PointMap;
using test::slanted;

namespace {

constexpr double no_taller_mm = 3.0;

/// A court of 52 x 52 mm within walls of 4 mm, whose every other cell is a merlon, those in the corners too.
mesh::Model castle(
    double merlon_mm, const PointMap& map = [](Vec3 p) { return p; }) {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 13; ++x) {
    for (int y = 0; y < 13; ++y) {
      cells.push_back({x, y, 0});
      if (x == 0 || y == 0 || x == 12 || y == 12) {
        cells.push_back({x, y, 1});
        if ((x + y) % 2 == 0) {
          cells.push_back({x, y, 2});
        }
      }
    }
  }
  return layers(cells, {0.0, 4.0, 24.0, 24.0 + merlon_mm}, map);
}

}  // namespace

TEST_CASE("battlements too low to be folded go, whichever way the castle lies", "[teeth]") {
  const PointMap map = GENERATE(PointMap([](Vec3 p) { return p; }), PointMap(slanted), PointMap(flipped));
  mesh::Model model = castle(2.4, map);
  CHECK(prepare::trim_teeth(model, {}, no_taller_mm, {}) == 24);
  test::check_invariants(model.surface);
  CHECK(test::volume(model.surface) == Approx(52.0 * 52.0 * 24.0 - 44.0 * 44.0 * 20.0));
  // A box with a court: eight corners outside, eight inside.
  CHECK(model.surface.vertex_count() == 16);
}

TEST_CASE("battlements that can be folded stay", "[teeth]") {
  mesh::Model model = castle(3.5);
  const std::size_t faces = model.surface.face_count();
  CHECK(prepare::trim_teeth(model, {}, no_taller_mm, {}) == 0);
  CHECK(model.surface.face_count() == faces);
}

TEST_CASE("a few teeth of a model with many other faces stay", "[teeth]") {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 24; ++x) {
    for (int y = 0; y < 24; ++y) {
      cells.push_back({x, y, 0});
      if (x < 20 && x % 2 == 0 && y % 2 == 0) {
        cells.push_back({x, y, 1});
        cells.push_back({x, y, 2});
      }
    }
  }
  for (int y = 4; y < 9; y += 2) {
    cells.push_back({23, y, 1});
  }
  mesh::Model model = layers(cells, {0.0, 20.0, 22.0, 30.0});
  const double before = test::volume(model.surface);
  CHECK(prepare::trim_teeth(model, {}, no_taller_mm, {}) == 0);
  CHECK(test::volume(model.surface) == before);
}

TEST_CASE("low steps stay", "[teeth]") {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 5; ++y) {
      for (int z = 0; z <= x; ++z) {
        cells.push_back({x, y, z});
      }
    }
  }
  mesh::Model model = layers(cells, {0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0});
  const double before = test::volume(model.surface);
  CHECK(prepare::trim_teeth(model, {}, no_taller_mm, {}) == 0);
  CHECK(test::volume(model.surface) == before);
}

TEST_CASE("teeth of bodies go before these are united, where there are too many faces", "[teeth]") {
  mesh::Model model = castle(2.4);
  mesh::LooseFaces bodies = mesh::take_apart(model);
  const mesh::LooseFaces tower = mesh::take_apart(layers({{3, 3, 0}, {3, 4, 0}}, {3.0, 40.0}, [](Vec3 p) {
    return p + Vec3{4, 4, 0};
  }));
  const auto first = static_cast<std::uint32_t>(bodies.points.size());
  bodies.points.insert(bodies.points.end(), tower.points.begin(), tower.points.end());
  for (std::size_t f = 0; f < tower.faces.size(); ++f) {
    const auto& [a, b, c] = tower.faces[f];
    bodies.add(tower, f, {a + first, b + first, c + first});
  }
  mesh::put_together(model, std::move(bodies));
  REQUIRE(model.surface.component_count() == 2);
  for (const bool too_many : {true, false}) {
    mesh::Model ready = model;
    prepare::SimplifyOptions options;
    options.most_faces = too_many ? 100 : 1000;
    options.largest_deviation = 0.1;  // it is a small castle
    prepare::SizeOptions size;
    size.mm_per_unit = 1.0;
    const prepare::ReadyReport report = prepare::ready_bodies(ready, size, options, {});
    CHECK(report.teeth.count == (too_many ? 24 : 0));
    CHECK(report.teeth.moved_mm == Approx(too_many ? 2.4 : 0.0));
  }
}
