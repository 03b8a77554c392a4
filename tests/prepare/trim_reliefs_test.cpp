// SPDX-License-Identifier: GPL-3.0-or-later
// What is shallow within a wall goes, alone where something deep begins there, too.
#include "prepare/features/trim_reliefs.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/layers.hpp"

using namespace ridgecraft;
using test::border_edges;
using test::flipped;
using test::layers;
using test::PointMap;
using test::slanted;

namespace {

/// A block of 48 x 48 x 20 mm with a window of 16 x 16 mm, `deep` mm deep. A lintel and a sill stand out of
/// the wall by `high` mm, and lie along the window as long as it and one cell more on either side.
std::vector<std::array<int, 3>> window_cells() {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 12; ++x) {
    for (int y = 0; y < 12; ++y) {
      cells.push_back({x, y, 0});
      if (x < 4 || x > 7 || y < 4 || y > 7) {
        cells.push_back({x, y, 1});
      }
      if (x >= 3 && x <= 8 && (y == 3 || y == 8)) {
        cells.push_back({x, y, 2});
      }
    }
  }
  return cells;
}

mesh::Model window(
    double deep, double high, const PointMap& map = [](Vec3 p) { return p; }) {
  return layers(window_cells(), {0.0, 20.0 - deep, 20.0, 20.0 + high}, map);
}

}  // namespace

TEST_CASE("what is shallow within a wall goes, whatever its length", "[reliefs]") {
  // A block of 40 x 40 x 20 mm. On its upper side stands a plate of 2 mm, in its lower one is a hollow as
  // deep, ...
  const auto block = [](double plate_mm, int plate_cells) {
    std::vector<std::array<int, 3>> cells;
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 10; ++y) {
        const bool inner = x >= 2 && x < 2 + plate_cells && y >= 3 && y < (plate_cells < 6 ? 6 : 9);
        for (int z = inner ? 1 : 0; z < (inner ? 3 : 2); ++z) {
          cells.push_back({x, y, z});
        }
      }
    }
    return layers(cells, {-plate_mm, 0.0, 20.0, 20.0 + plate_mm});
  };
  mesh::Model model = block(2.0, 4);
  CHECK(prepare::trim_reliefs(model, {}, 3.0, {}) == 2);
  CHECK(model.surface.face_count() == 12);
  test::check_invariants(model.surface);
  // ... and what is higher than the surface may move, or than a fold can be short, stays, as does what is
  // most of its wall.
  for (const auto& [high, cells, may_move] : {std::tuple{2.0, 4, 1.5}, {3.5, 4, 3.0}, {2.0, 6, 3.0}}) {
    CAPTURE(high, cells, may_move);
    mesh::Model same = block(high, cells);
    CHECK(prepare::trim_reliefs(same, {}, may_move, {}) == 0);
  }
}

TEST_CASE("sill and lintel go, and the deep window between them stays", "[reliefs]") {
  const PointMap map = GENERATE(PointMap([](Vec3 p) { return p; }), PointMap(slanted), PointMap(flipped));
  mesh::Model model = window(5.0, 2.0, map);
  CHECK(prepare::trim_reliefs(model, {}, 3.0, {}) == 2);
  test::check_invariants(model.surface);
  CHECK(border_edges(model.surface) == 0);
  CHECK(test::volume(model.surface) == Approx(48.0 * 48.0 * 20.0 - 16.0 * 16.0 * 5.0));
  // A box with a hollow: 16 corners, and a ring of 8 triangles around the opening.
  CHECK(model.surface.vertex_count() == 16);
  CHECK(model.surface.face_count() == 28);
}

TEST_CASE("a shallow window goes, and what stands out far beside it stays", "[reliefs]") {
  mesh::Model model = window(2.0, 5.0);
  CHECK(prepare::trim_reliefs(model, {}, 3.0, {}) == 1);
  test::check_invariants(model.surface);
  CHECK(border_edges(model.surface) == 0);
  CHECK(test::volume(model.surface) == Approx(48.0 * 48.0 * 20.0 + 2.0 * 24.0 * 4.0 * 5.0));
  mesh::Model deep = window(5.0, 5.0);
  const std::size_t faces = deep.surface.face_count();
  CHECK(prepare::trim_reliefs(deep, {}, 3.0, {}) == 0);
  CHECK(deep.surface.face_count() == faces);
}

TEST_CASE("a wall goes on over a shallow frame that is open at its back", "[reliefs]") {
  mesh::Model model = window(2.0, 1.0);
  // The window's pane is missing.
  std::vector<bool> kept;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    bool pane = true;
    for (const VertexId v : model.surface.vertices(f)) {
      pane = pane && std::abs(model.surface.point(v).z - 18.0) < 1e-9;
    }
    kept.push_back(!pane);
  }
  mesh::keep_faces(model, kept);
  REQUIRE(border_edges(model.surface) == 4);
  CHECK(prepare::trim_reliefs(model, {}, 3.0, {}) == 1);
  test::check_invariants(model.surface);
  CHECK(border_edges(model.surface) == 0);
  CHECK(model.surface.face_count() == 12);
}
