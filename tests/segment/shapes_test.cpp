// SPDX-License-Identifier: GPL-3.0-or-later
// Whole shapes with the number of parts that they must have.
#include "support/shapes.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "segment/evaluate.hpp"
#include "segment/segment.hpp"
#include "segmented.hpp"
#include "support/concave_shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Segmentation;
using test::labels_of;
using test::tolerance;

/// Rays a side for volumes; faces parallel to the grid cost up to 1.5 % with fewer.
constexpr unsigned rays = 512;

/// What must hold for every segmentation whatever the shape.
void check_promises(const mesh::Surface& surface, const Segmentation& s) {
  REQUIRE(s.part.size() == surface.face_count());
  std::size_t faces = 0;
  FaceId previous(0);
  for (const PartId id : ids<PartId>(s.parts.size())) {
    const segment::Part& part = s.parts[id];
    REQUIRE(!part.faces.empty());
    CHECK(part.faces.front() >= previous);
    previous = part.faces.front();
    CHECK(std::is_sorted(part.faces.begin(), part.faces.end()));
    for (const FaceId f : part.faces) {
      REQUIRE(s.part[f] == id);
    }
    faces += part.faces.size();
    CHECK(part.concavity <= tolerance);
    CHECK(std::is_sorted(part.hull_vertices.begin(), part.hull_vertices.end()));
    // Connected over edges.
    std::set<FaceId> open(part.faces.begin(), part.faces.end());
    std::vector<FaceId> stack{part.faces.front()};
    open.erase(part.faces.front());
    while (!stack.empty()) {
      const FaceId f = stack.back();
      stack.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = surface.neighbor(mesh::corner(f, k));
        if (g.valid() && open.erase(g) == 1) {
          stack.push_back(g);
        }
      }
    }
    CHECK(open.empty());
  }
  CHECK(faces == surface.face_count());
}

Segmentation checked_parts(const mesh::Surface& surface) {
  Segmentation s = segment::segment(surface, {}, {tolerance}, Context{});
  check_promises(surface, s);
  return s;
}

std::size_t parts_of(const mesh::Surface& surface) {
  return checked_parts(surface).parts.size();
}

double ratio_of(const mesh::Surface& surface, const Segmentation& s) {
  return segment::hull_volume_ratio(surface, labels_of(s), rays, Context{});
}

std::vector<std::array<int, 3>> row(int from, int to, int y = 0) {
  std::vector<std::array<int, 3>> cells;
  for (int x = from; x <= to; ++x) {
    cells.push_back({x, y, 0});
  }
  return cells;
}

std::vector<std::array<int, 3>> operator+(std::vector<std::array<int, 3>> a,
                                          const std::vector<std::array<int, 3>>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_CASE("Convex shapes are one part") {
  CHECK(parts_of(test::voxels({{0, 0, 0}}, 10)) == 1);
  const Segmentation ball = checked_parts(test::sphere(64, 32));
  CHECK(ball.parts.size() == 1);
  CHECK(ball.max_concavity() < 1e-6);
  CHECK(ball.parts[PartId(0)].hull_volume == Approx(4.0 / 3.0 * std::numbers::pi).epsilon(0.01));
  Random random(7);
  CHECK(parts_of(test::star_shaped([&](Vec3) { return 1.0 + 0.02 * random.unit(); }, 100, 50)) == 1);
  CHECK(parts_of(test::plate(0.02, [](int, int) { return true; })) == 1);
  CHECK(parts_of(test::turned({{0, 0}, {1, 0}, {1, 0.03}, {0, 0.03}})) == 1);
}

TEST_CASE("Overlapping spheres part at their crease") {
  const mesh::Surface two = test::sphere_chain({-0.7, 0.7});
  const Segmentation s = checked_parts(two);
  REQUIRE(s.parts.size() == 2);
  CHECK(ratio_of(two, s) == Approx(1.0).margin(0.005));
  for (const FaceId f : ids<FaceId>(two.face_count())) {
    double z = 0.0;
    for (const VertexId v : two.vertices(f)) {
      z += two.point(v).z;
    }
    CHECK((z < 0.0) == (s.part[f] == PartId(0)));
  }
  CHECK(parts_of(test::sphere_chain({-1.5, 0.0, 1.5})) == 3);
}

TEST_CASE("Shapes of cubes part into their arms") {
  const auto l = checked_parts(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 8));
  CHECK(l.parts.size() >= 2);
  CHECK(l.parts.size() <= 3);
  const mesh::Surface plus = test::voxels({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 6);
  const auto plus_parts = checked_parts(plus);
  CHECK(plus_parts.parts.size() >= 2);
  CHECK(plus_parts.parts.size() <= 3);
  CHECK(ratio_of(plus, plus_parts) <= 1.05);
  const mesh::Surface cross =
      test::voxels({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 6);
  const auto cross_parts = checked_parts(cross);
  CHECK(cross_parts.parts.size() == 6);
  CHECK(ratio_of(cross, cross_parts) == Approx(6.0 / 7.0).margin(0.01));
  CHECK(parts_of(test::voxels(row(0, 2) + std::vector<std::array<int, 3>>{{0, 1, 0}, {2, 1, 0}}, 8)) == 3);
  CHECK(parts_of(test::voxels(row(0, 7) + std::vector<std::array<int, 3>>{{0, 1, 0}, {7, 1, 0}}, 5)) == 3);
  const std::size_t stairs = parts_of(test::voxels(row(0, 2) + row(0, 1, 1) + row(0, 0, 2), 6));
  CHECK(stairs >= 2);
  CHECK(stairs <= 3);
  const std::size_t l_plate = parts_of(test::plate(0.02, [](int i, int j) { return i < 4 || j < 4; }));
  CHECK(l_plate >= 2);
  CHECK(l_plate <= 3);
}

TEST_CASE("A table is its top and its legs") {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 5; ++x) {
    cells = cells + row(0, 4, x);
  }
  for (const int x : {0, 4}) {
    for (const int y : {0, 4}) {
      for (int z = -3; z < 0; ++z) {
        cells.push_back({x, y, z});
      }
    }
  }
  CHECK(parts_of(test::voxels(cells, 4)) == 5);
}

TEST_CASE("Round shapes part at their waists") {
  const mesh::Surface dumbbell = test::dumbbell();
  const auto d = checked_parts(dumbbell);
  CHECK(d.parts.size() == 3);
  CHECK(ratio_of(dumbbell, d) == Approx(1.0).margin(0.005));
  const mesh::Surface hourglass = test::turned({{0, -1}, {0.8, -1}, {0.15, 0}, {0.8, 1}, {0, 1}});
  const auto h = checked_parts(hourglass);
  REQUIRE(h.parts.size() == 2);
  for (const EdgeId e : ids<EdgeId>(hourglass.edge_count())) {
    const auto [c, t] = hourglass.sides(e);
    if (h.part[mesh::face_of(c)] != h.part[mesh::face_of(t)]) {
      CHECK(std::abs(hourglass.point(hourglass.vertex(c)).z) < 0.11);
    }
  }
  for (const double tube : {0.1, 0.3, 0.6}) {
    CAPTURE(tube);
    const std::size_t parts = parts_of(test::torus(1.0, tube));
    CHECK(parts >= 6);
    CHECK(parts <= 10);
  }
}

TEST_CASE("Spikes and arms are parts of their own") {
  CHECK(parts_of(test::spiked_sphere(12, 0.012, 160, 80)) == 13);
  const std::size_t star = parts_of(test::star_shaped(
      [](Vec3 p) {
        const double phi = std::atan2(p.y, p.x);
        return 1.0 - 0.5 * std::abs(std::sin(2.5 * phi)) * std::sqrt(std::max(0.0, 1.0 - p.z * p.z));
      },
      160, 60));
  CHECK(star >= 5);
  CHECK(star <= 6);
}

TEST_CASE("Thin-walled vessels stay whole without the pocket check") {
  CHECK(parts_of(test::turned({{0, 0}, {1, 0}, {1, 2}, {0.9, 2}, {0.9, 0.1}, {0, 0.1}})) == 1);
  std::vector<Vec2> bowl;
  for (int k = 0; k <= 16; ++k) {
    const double angle = std::numbers::pi / 2 * k / 16;
    bowl.push_back({k == 0 ? 0.0 : std::sin(angle), -std::cos(angle)});
  }
  for (int k = 16; k >= 0; --k) {
    bowl.push_back({0.93 * (k == 0 ? 0.0 : std::sin(std::numbers::pi / 2 * k / 16)),
                    -0.93 * std::cos(std::numbers::pi / 2 * k / 16)});
  }
  CHECK(parts_of(test::revolve(bowl, 64)) == 1);
  // Chords of an uneven rim run over the inner wall's top row, whose normals lead across the whole cup.
  CHECK(parts_of(test::uneven_cup()) == 1);
  std::vector<std::array<int, 3>> box;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) {
        if (x == 0 || x == 7 || y == 0 || y == 7 || z == 0) {
          box.push_back({x, y, z});
        }
      }
    }
  }
  CHECK(parts_of(test::voxels(box, 2)) == 1);
  std::vector<std::array<int, 3>> ring;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      if (x == 0 || x == 4 || y == 0 || y == 4) {
        ring.push_back({x, y, 0});
      }
    }
  }
  CHECK(parts_of(test::voxels(ring, 4)) == 1);
  // The tray of this disk is deeper than the tolerance, and the bridges over its opening see that.
  CHECK(parts_of(test::turned({{0, 0}, {1, 0}, {1, 0.25}, {0.94, 0.25}, {0.94, 0.06}, {0, 0.06}})) <= 6);
}

TEST_CASE("The flat sides of a thin fork are no openings") {
  // Two prongs, half as wide as the gap between them, on a back, as thick as the tolerance. Halfway up, the
  // sides towards the gap bulge and the outer ones are dented, by a fiftieth of the thickness.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 12; ++y) {
      if (x < 4 || y < 3 || y >= 9) {
        cells.push_back({x, y, 0});
      }
    }
  }
  CHECK(parts_of(test::mapped(test::voxels(cells, 2), [](Vec3 p) {
          const double bulge = p.z == 0.5 ? 0.02 : 0.0;
          return p + Vec3{0.0, bulge * (p.y < 6.0 ? 1.0 : -1.0), 0.0};
        })) >= 2);
}

TEST_CASE("A component that nothing divides says so, at each effort and with planes") {
  const mesh::Surface apart = test::mapped(test::cube(), [](Vec3 p) { return p + Vec3{3.0, 0.0, 0.0}; });
  const mesh::Surface two = test::together({test::cube(), apart});
  for (const int effort : {1, 2, 3}) {
    for (const bool planes : {false, true}) {
      segment::Options options;
      options.effort = effort;
      options.planes = planes;
      const auto whole = segment::segment(two, {}, options, Context{});
      REQUIRE(whole.parts.size() == 2);
      for (const segment::Part& part : whole.parts) {
        CHECK(part.reason == segment::PartReason::component);
      }
      for (const segment::Part& part : segment::segment(test::dumbbell(), {}, options, Context{}).parts) {
        CHECK(part.reason != segment::PartReason::component);
      }
    }
  }
}

TEST_CASE("Components are segmented each by itself") {
  const auto at = [](const mesh::Surface& s, double x) {
    return test::mapped(s, [=](Vec3 p) { return p + Vec3{x, 0, 0}; });
  };
  const mesh::Surface three = test::together({at(test::sphere(48, 24), 0.0),
                                              at(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 8), 3.0),
                                              at(test::voxels({{0, 0, 0}}, 4), 7.0)});
  CHECK(parts_of(three) == 4);
}

TEST_CASE("Tiny and degenerate surfaces") {
  const auto surface = [](std::vector<Vec3> points, const std::vector<std::array<int, 3>>& faces) {
    std::vector<std::array<VertexId, 3>> corners;
    for (const auto& f : faces) {
      corners.push_back({VertexId(f[0]), VertexId(f[1]), VertexId(f[2])});
    }
    return mesh::Surface(std::move(points), std::move(corners));
  };
  CHECK(parts_of(surface({}, {})) == 0);
  CHECK(parts_of(surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})) == 1);
  CHECK(parts_of(surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {{0, 1, 2}, {2, 1, 3}})) == 1);
  CHECK(parts_of(test::tetrahedron()) == 1);
  // All points equal; all on a line; a facet without area among others.
  CHECK(parts_of(surface({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}})) == 1);
  CHECK(parts_of(surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {2, 1, 3}})) == 1);
  CHECK(parts_of(surface({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                         {{0, 2, 3}, {2, 1, 3}, {0, 1, 2}, {1, 0, 4}})) == 1);
  // A flat L of four triangles: its bridge runs outside.
  const auto flat_l = surface({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  CHECK(parts_of(flat_l) == 2);
  const std::vector<std::uint32_t> one_polygon(4, 0);
  CHECK(segment::segment(flat_l, one_polygon, {tolerance}, Context{}).parts.size() == 1);
}

TEST_CASE("A polygon's triangles stay in one part") {
  const mesh::Surface cross =
      test::voxels({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 4);
  std::vector<std::uint32_t> polygon;
  for (std::uint32_t f = 0; f < cross.face_count(); ++f) {
    polygon.push_back(f / 2);
  }
  const Segmentation s = segment::segment(cross, polygon, {tolerance}, Context{});
  check_promises(cross, s);
  CHECK(s.parts.size() == 6);
  for (std::uint32_t f = 0; f < cross.face_count(); f += 2) {
    CHECK(s.part[FaceId(f)] == s.part[FaceId(f + 1)]);
  }
}

TEST_CASE("A surface rougher than the tolerance comes to an end") {
  Random random(3);
  const mesh::Surface hedgehog = test::star_shaped([&](Vec3) { return 1.0 + random.unit(); }, 60, 30);
  const Segmentation s = checked_parts(hedgehog);
  CHECK(s.parts.size() > 64);
}

TEST_CASE("Bad tolerances are refused, a request to stop is obeyed") {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(segment::segment(test::cube(), {}, {bad}, Context{}), Error);
  }
  StopSource stop;
  Context context;
  context.stop = stop.get_token();
  stop.request_stop();
  CHECK_THROWS_AS(segment::segment(test::cube(), {}, {tolerance}, context), Error);
}

}  // namespace ridgecraft
