// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/shade.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;

namespace {

mesh::Look shaded(const mesh::Surface& surface) {
  mesh::LookParts parts = mesh::white_look(surface);
  mesh::add_shade(parts, {});
  return mesh::Look(std::move(parts));
}

int light(const mesh::Look& look, Vec3 p, Vec3 normal) {
  return look.colour_at(look.nearest(p, normal), 0.0)[0];
}

}  // namespace

TEST_CASE("What is convex has no shade") {
  const mesh::Look look = shaded(sphere(24, 12));
  for (const mesh::LookFace& face : look.faces()) {
    REQUIRE(face.colours);
    for (const mesh::Rgb& colour : *face.colours) {
      CHECK(colour == mesh::Rgb{255, 255, 255});
    }
  }
}

TEST_CASE("The bottom of a groove is darker than its rims, and darkest in its corners") {
  // A slab of 10 by 10, and on it two halves with a groove of one between them.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 11; ++x) {
    for (int y = 0; y < 11; ++y) {
      cells.push_back({x, y, 0});
      if (x != 5) {
        cells.push_back({x, y, 1});
      }
    }
  }
  const mesh::Look look = shaded(voxels(cells));
  const int rim = light(look, {2.5, 5.5, 2.0}, {0, 0, 1});
  const int bottom = light(look, {5.5, 5.5, 1.0}, {0, 0, 1});
  const int corner = light(look, {5.05, 5.5, 1.0}, {0, 0, 1});
  CHECK(rim == 255);
  CHECK(bottom < 235);
  CHECK(corner < bottom);
  CHECK(corner >= 255 * 2 / 5 - 1);
}
