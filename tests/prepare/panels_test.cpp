// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions are found and got along with their corners.
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepare.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using mesh::Model;

namespace {

Model remeshed(const mesh::Surface& surface) {
  Model model = test::repaired(test::soup_of(surface));
  prepare::remesh_panels(model, {});
  test::check_invariants(model.surface);
  return model;
}

}  // namespace

TEST_CASE("a finely divided cube has 6 panels and becomes 12 faces", "[panels]") {
  const mesh::Surface fine = test::voxels({{0, 0, 0}}, 9);
  CHECK(prepare::find_panels(fine).count() == 6);
  const Model model = remeshed(fine);
  CHECK(model.surface.face_count() == 12);
  CHECK(test::volume(model.surface) == Approx(1.0));
}

TEST_CASE("concave panels and panels with holes keep their outline", "[panels]") {
  SECTION("an L of cubes has 8 panels") {
    const Model model = remeshed(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 4));
    CHECK(prepare::find_panels(model.surface).count() == 8);
    CHECK(model.surface.vertex_count() == 12);
    CHECK(test::volume(model.surface) == Approx(3.0));
  }
  SECTION("a square ring has 10 panels and stays genus 1") {
    std::vector<std::array<int, 3>> cells;
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        if (x != 1 || y != 1) {
          cells.push_back({x, y, 0});
        }
      }
    }
    const Model model = remeshed(test::voxels(cells, 3));
    CHECK(prepare::find_panels(model.surface).count() == 10);
    CHECK(model.surface.vertex_count() == 16);
    CHECK(test::euler(model.surface) == 0);
    CHECK(test::volume(model.surface) == Approx(8.0));
  }
}

TEST_CASE("a cylinder of many strips is not one panel", "[panels]") {
  const mesh::Surface tube = test::revolve({{1, 0}, {1, 1}}, 2000);
  const prepare::Panels panels = prepare::find_panels(tube);
  CHECK(panels.count() >= 500);
  std::size_t faces = 0;
  for (const auto& panel : panels.faces) {
    CHECK(std::is_sorted(panel.begin(), panel.end()));
    faces += panel.size();
  }
  CHECK(faces == tube.face_count());
  const Model model = remeshed(tube);
  CHECK(test::area(model.surface) == Approx(test::area(tube)).epsilon(1e-4));
  CHECK(test::euler(model.surface) == 0);
}

TEST_CASE("panels end where the material changes", "[panels]") {
  Model model = test::repaired(test::soup_of(test::voxels({{0, 0, 0}}, 2)));
  model.material = IdVector<FaceId, std::uint32_t>(model.surface.face_count(), 0);
  // One quarter of the top is red: its outline must stay.
  std::size_t red = 0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    bool quarter = true;
    for (const VertexId v : model.surface.vertices(f)) {
      const Vec3 p = model.surface.point(v);
      quarter = quarter && p.z == 1.0 && p.x <= 0.5 && p.y <= 0.5;
    }
    model.material[f] = quarter ? 1 : 0;
    red += quarter ? 1U : 0U;
  }
  REQUIRE(red == 2);
  prepare::remesh_panels(model, {});
  test::check_invariants(model.surface);
  double red_area = 0.0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    red_area += model.material[f] == 1 ? model.surface.area(f) : 0.0;
  }
  CHECK(red_area == Approx(0.25));
  CHECK(model.surface.vertex_count() == 8 + 3);
}

TEST_CASE("remeshing random voxel shapes keeps volume, genus and panels", "[panels]") {
  Random random(7);
  for (int round = 0; round < 25; ++round) {
    std::vector<std::array<int, 3>> cells;
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 2; ++z) {
          if (random.below(3) != 0) {
            cells.push_back({x, y, z});
          }
        }
      }
    }
    if (cells.empty()) {
      continue;
    }
    // test::voxels may touch at edges and corners only: build a soup of its squares, repair splits it.
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    for (const auto& cell : cells) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          auto other = cell;
          other[static_cast<std::size_t>(axis)] += side == 0 ? -1 : 1;
          if (std::find(cells.begin(), cells.end(), other) != cells.end()) {
            continue;
          }
          std::vector<std::uint32_t> face;
          for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
            std::array<double, 3> p{double(cell[0]), double(cell[1]), double(cell[2])};
            p[static_cast<std::size_t>(axis)] += side;
            p[static_cast<std::size_t>((axis + 1) % 3)] += u;
            p[static_cast<std::size_t>((axis + 2) % 3)] += v;
            face.push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back({p[0], p[1], p[2]});
          }
          if (side == 0) {
            std::reverse(face.begin(), face.end());
          }
          faces.push_back(face);
        }
      }
    }
    Model model = test::repaired(test::soup(points, faces));
    CHECK(test::volume(model.surface) == Approx(double(cells.size())));
    const std::size_t panels = prepare::find_panels(model.surface).count();
    const int euler = test::euler(model.surface);
    prepare::remesh_panels(model, {});
    test::check_invariants(model.surface);
    CHECK(test::volume(model.surface) == Approx(double(cells.size())));
    CHECK(prepare::find_panels(model.surface).count() == panels);
    CHECK(test::euler(model.surface) == euler);
  }
}
