// SPDX-License-Identifier: GPL-3.0-or-later
// Solids cut by planes: both sides together are the solid, closed, and connected pieces stay whole.
#include "solid/cuts.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "segment/segment.hpp"
#include "solid/solid.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

/// As many triangles run along each edge one way as the other; points that rounding parts are one.
bool edges_cancel(const solid::Body& body) {
  using Place = std::array<long, 3>;
  const auto place = [&](std::uint32_t v) {
    const Vec3 p = body.points[v];
    return Place{std::lround(1e9 * p.x), std::lround(1e9 * p.y), std::lround(1e9 * p.z)};
  };
  std::map<std::pair<Place, Place>, int> runs;
  for (const auto& t : body.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = place(t[k]);
      const Place b = place(t[(k + 1) % 3]);
      if (a != b) {
        runs[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
  }
  for (const auto& [edge, sum] : runs) {
    if (sum != 0) {
      return false;
    }
  }
  return true;
}

double volume_of(const solid::Body& body) {
  return solid::mass_properties(body).volume;
}

/// A ring of square section about the z axis, and a table: a plate of 5 x 5 cells on four legs.
const mesh::Surface& ring() {
  static const mesh::Surface surface =
      test::revolve({{2.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {2.0, 1.0}, {2.0, 0.0}}, 24);
  return surface;
}

mesh::Surface plate_on_legs() {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      cells.push_back({x, y, 3});
      for (int z = 0; z < 3 && x % 4 == 0 && y % 4 == 0; ++z) {
        cells.push_back({x, y, z});
      }
    }
  }
  return test::voxels(cells, 1);
}

}  // namespace

TEST_CASE("Both sides of a plane are closed, and together the solid") {
  Random random(3);
  for (const solid::Body& body : {solid::body_of(test::sphere(24, 16)), solid::body_of(plate_on_legs()),
                                  solid::body_of(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 2))}) {
    const double volume = volume_of(body);
    std::vector<solid::HalfSpace> planes;
    for (int i = 0; i < 20; ++i) {
      const Vec3 normal = normalized(Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
      planes.push_back({normal, dot(normal, body.points[static_cast<std::size_t>(i)]) + 0.3 * i - 3.0});
    }
    // Along sides, where whole triangles lie in the plane, and through vertices.
    for (const double at : {0.0, 1.0, 3.0, 4.0}) {
      planes.push_back({{0, 0, 1}, at});
      planes.push_back({{-1, 0, 0}, -at});
    }
    for (const solid::HalfSpace& half : planes) {
      const solid::Body low = solid::clipped(body, half);
      const solid::Body high = solid::clipped(body, {-1.0 * half.normal, -half.offset});
      CHECK(edges_cancel(low));
      CHECK(edges_cancel(high));
      CHECK(volume_of(low) + volume_of(high) == Approx(volume).epsilon(1e-9));
      for (const Vec3 p : low.points) {
        CHECK(dot(half.normal, p) <= half.offset + 1e-12);
      }
    }
  }
}

TEST_CASE("A cap joins the skins that it lies between, and apart stays apart") {
  // Half a ring ends in two squares, which join its inner and its outer side.
  const solid::Body half = solid::clipped(solid::body_of(ring()), {{0, 1, 0}, 0.01});
  CHECK(solid::pieces_of(half).size() == 1);
  const solid::Body lower = solid::clipped(solid::body_of(ring()), {{0, 0, 1}, 0.5});
  CHECK(solid::pieces_of(lower).size() == 1);
  CHECK(solid::pieces_of(solid::clipped(solid::body_of(plate_on_legs()), {{0, 0, 1}, 3.0})).size() == 4);
  CHECK(solid::pieces_of(solid::clipped(solid::body_of(plate_on_legs()), {{0, 0, -1}, -3.0})).size() == 1);
}

TEST_CASE("What is made of boxes falls into them") {
  for (const solid::Body& piece :
       solid::cut_by_planes(solid::body_of(plate_on_legs()), 1e-6, 12, Context{})) {
    CHECK(volume_of(piece) == Approx(volume_of(piece) < 10.0 ? 3.0 : 25.0));
  }
  // As one or a few parts of the surface it would be a block.
  const mesh::Surface surface = plate_on_legs();
  const auto parts = segment::segment(surface, {}, {}, Context{});
  const solid::HullSet set = solid::model_hulls(surface, parts, {.max_hulls = 5}, Context{});
  CHECK(set.bodies.size() <= 5);
  CHECK(set.fit.union_volume == Approx(37.0).epsilon(0.01));
}

}  // namespace ridgecraft
