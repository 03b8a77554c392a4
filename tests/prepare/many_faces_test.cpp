// SPDX-License-Identifier: GPL-3.0-or-later
// How many triangles a model may keep.
#include "prepare/simplify/many_faces.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

#include "prepare/layers.hpp"
#include "prepare/prepared/panels.hpp"

using namespace ridgecraft;

TEST_CASE("walls may have more triangles than what has none", "[simplify]") {
  // A plate with posts: each wall has several triangles, most of all the ground between the posts.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 13; ++x) {
    for (int y = 0; y < 13; ++y) {
      cells.push_back({x, y, 0});
      if (x % 2 == 1 && y % 2 == 1) {
        cells.push_back({x, y, 1});
      }
    }
  }
  const mesh::Model walls = test::layers(cells, {0.0, 4.0, 24.0});
  const std::size_t triangles = walls.surface.face_count();
  const std::size_t flat = prepare::find_panels(walls.surface).count();
  REQUIRE(triangles >= 3 * flat);
  prepare::SimplifyOptions options;
  options.most_faces = triangles;
  CHECK(prepare::most_triangles(walls.surface, options) == triangles);
  options.most_faces = triangles * 4 / 5;
  for (const std::size_t share : {std::size_t{1}, std::size_t{2}}) {
    options.most_flat_faces = flat / share;
    const std::size_t most = prepare::most_triangles(walls.surface, options);
    CHECK(most == (share == 1 ? triangles : options.most_faces));
  }
  options.most_faces = triangles / 4;
  options.most_flat_faces = flat;
  CHECK(prepare::most_triangles(walls.surface, options) == options.most_faces * 135 / 100);
  // Of a dome each triangle is a flat face.
  const mesh::Surface dome = test::sphere(20, 12);
  options.most_faces = dome.face_count() / 2;
  CHECK(prepare::most_triangles(dome, options) == options.most_faces);
}
