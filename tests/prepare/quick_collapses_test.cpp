// SPDX-License-Identifier: GPL-3.0-or-later
// The first collapses of models of very many faces.
#include "prepare/collapses/quick_collapses.hpp"

#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/common_models.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using test::free_points;
using test::ring;

namespace {

mesh::LooseFaces fine(const mesh::Surface& surface) {
  return mesh::take_apart(test::repaired(test::soup_of(surface)));
}

mesh::Surface surface_of(const mesh::LooseFaces& loose) {
  mesh::Model model;
  mesh::put_together(model, loose);
  return model.surface;
}

double distance(const mesh::LooseFaces& a, const mesh::LooseFaces& b) {
  const mesh::Surface of_a = surface_of(a);
  const mesh::Surface of_b = surface_of(b);
  return greatest_distance(mesh::SurfaceTree(of_a, 0.05), mesh::SurfaceTree(of_b, 0.05), INFINITY, {});
}

}  // namespace

TEST_CASE("quick collapses leave a surface near the one before, wherever they end", "[quick_collapses]") {
  const mesh::LooseFaces loose = fine(test::sphere(160, 80));
  const auto collapses = prepare::quick_collapses(loose, free_points(loose), {}, 2000, INFINITY, {});
  REQUIRE(collapses.size() > 10000);
  CHECK(collapses.back().faces <= 2000);
  CHECK(collapses.back().faces >= 1998);
  for (std::size_t count = 1000; count <= collapses.size(); count += 1000) {
    const mesh::LooseFaces faces = prepare::replay(loose, std::span(collapses).first(count));
    CHECK(faces.faces.size() == collapses[count - 1].faces);
    CHECK(mesh::is_surface(faces));
    CHECK(test::euler(surface_of(faces)) == 2);
  }
  // Of a sphere with so many even faces the sides are 0.08 long, and the arrows over them 0.001.
  CHECK(distance(loose, prepare::replay(loose, collapses)) < 0.005);
}

TEST_CASE("quick collapses keep borders, walls and points of a plane", "[quick_collapses]") {
  const mesh::LooseFaces tube = fine(test::revolve({{1, 0}, {1.1, 0.5}, {1.05, 1}, {1, 1.5}}, 80));
  // Two rings are borders, so nothing but the two between can go.
  const auto of_tube = prepare::quick_collapses(tube, free_points(tube), {}, 0, INFINITY, {});
  for (const prepare::Collapse& c : of_tube) {
    const double height = tube.points[c.gone].z;
    CHECK(height > 0.1);
    CHECK(height < 1.4);
  }
  const mesh::LooseFaces torus = fine(test::revolve(ring, 100));
  prepare::PointRules points = free_points(torus);
  prepare::Walls walls;
  walls.walls.push_back({{0, 0, 1}, 0.5});
  walls.of_face.assign(torus.faces.size(), prepare::Walls::none);
  std::vector<bool> bound(torus.points.size(), false);
  for (std::size_t v = 0; v < torus.points.size(); ++v) {
    if (torus.points[v].x < -2.0) {
      points.plane[v] = 0;
      bound[v] = true;
    }
  }
  points.planes.push_back({{1, 0, 0}, -2.0});
  for (std::size_t f = 0; f < torus.faces.size(); f += 50) {
    walls.of_face[f] = 0;
    for (const std::uint32_t v : torus.faces[f]) {
      bound[v] = true;
    }
  }
  const auto collapses = prepare::quick_collapses(torus, points, walls, 0, INFINITY, {});
  REQUIRE(collapses.size() > 50);
  for (const prepare::Collapse& c : collapses) {
    CHECK_FALSE(bound[c.gone]);
    CHECK_FALSE(bound[c.stays]);
  }
  const mesh::LooseFaces left = prepare::replay(torus, collapses);
  CHECK(mesh::is_surface(left));
  CHECK(test::euler(surface_of(left)) == 0);
}

TEST_CASE("quick collapses end where nothing is left to be done", "[quick_collapses]") {
  const mesh::LooseFaces cube = fine(test::voxels({{0, 0, 0}}, 1));
  CHECK(prepare::quick_collapses(cube, free_points(cube), {}, 0, INFINITY, {}).size() <= 4);
  const mesh::LooseFaces nothing =
      prepare::replay(cube, prepare::quick_collapses(cube, free_points(cube), {}, 0, INFINITY, {}));
  CHECK(mesh::is_surface(nothing));
}
