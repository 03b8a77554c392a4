// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that are not one closed solid: components tied together, holes and crumbs of damaged ones.
#include "segment/surface/damage.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"
#include "segment/segment.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Options;

mesh::Surface moved(const mesh::Surface& surface, Vec3 by) {
  return test::mapped(surface, [by](Vec3 p) { return p + by; });
}

segment::Segmentation tied(const mesh::Surface& surface) {
  Options options;
  options.components = Options::Components::tied;
  return segment::segment(surface, {}, options, Context{});
}

/// Every face is in one part, and the parts tell the same as the faces.
void check_cover(const mesh::Surface& surface, const segment::Segmentation& s) {
  REQUIRE(s.part.size() == surface.face_count());
  std::size_t faces = 0;
  for (const PartId p : ids<PartId>(s.parts.size())) {
    CHECK(s.parts[p].concavity <= Options{}.concavity);
    for (const FaceId f : s.parts[p].faces) {
      CHECK(s.part[f] == p);
      ++faces;
    }
  }
  CHECK(faces == surface.face_count());
}

std::size_t components_of(const segment::ScaledSurface& s) {
  std::set<std::uint32_t> open;
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    open.insert(f);
  }
  std::size_t count = 0;
  while (!open.empty()) {
    ++count;
    std::vector<std::uint32_t> stack{*open.begin()};
    open.erase(open.begin());
    while (!stack.empty()) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      for (const std::uint32_t g : s.neighbors[f]) {
        if (g != no_index && open.erase(g) == 1) {
          stack.push_back(g);
        }
      }
    }
  }
  return count;
}

std::size_t borders_of(const segment::ScaledSurface& s) {
  std::size_t count = 0;
  for (const auto& neighbors : s.neighbors) {
    count += static_cast<std::size_t>(std::count(neighbors.begin(), neighbors.end(), no_index));
  }
  return count;
}

/// Neighbours know each other, and of two that share a side each runs through it in its own direction.
void check_neighbors(const segment::ScaledSurface& s) {
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == no_index) {
        continue;
      }
      bool mutual = false;
      for (std::uint32_t j = 0; j < 3; ++j) {
        mutual = mutual || (s.neighbors[g][j] == f && s.corners[g][j] == s.corners[f][(k + 1) % 3] &&
                            s.corners[g][(j + 1) % 3] == s.corners[f][k]);
      }
      CHECK(mutual);
    }
  }
}

}  // namespace

TEST_CASE("Ties make one component of several, as closed and as oriented as these were") {
  std::vector<mesh::Surface> all;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 3; ++y) {
      all.push_back(moved(test::tetrahedron(), {3.0 * x, 2.5 * y, 0.1 * x * y}));
    }
  }
  all.push_back(moved(test::cube(), {0.2, 0.2, 0.2}));  // runs through the first
  all.push_back(moved(test::cube(), {0.2, 0.2, 0.2}));  // lies on another, point for point
  segment::ScaledSurface s = segment::scale_surface(test::together(all), {});
  const std::size_t before = s.facet_count();
  REQUIRE(components_of(s) == 14);
  segment::tie_components(s);
  CHECK(components_of(s) == 1);
  CHECK(borders_of(s) == 0);
  CHECK(s.facet_count() == before + 4 * 13);
  check_neighbors(s);
}

TEST_CASE("Single triangles and one vertex that many components are nearest to can be tied") {
  const mesh::Surface triangle({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{VertexId(0), VertexId(1), VertexId(2)}});
  std::vector<mesh::Surface> all{triangle};
  for (int i = 0; i < 12; ++i) {
    const Vec3 away{-0.01 - 0.001 * i, -0.02 + 0.002 * i, 0.01 * (i % 3)};
    all.push_back(test::mapped(triangle, [&](Vec3 p) { return away - 0.1 * p; }));
  }
  segment::ScaledSurface s = segment::scale_surface(test::together(all), {});
  segment::tie_components(s);
  CHECK(components_of(s) == 1);
  check_neighbors(s);
}

TEST_CASE("Components in one row are one part when tied and several when not") {
  const mesh::Surface row = test::together(
      {test::cube(), moved(test::cube(), {1.01, 0.0, 0.0}), moved(test::cube(), {2.02, 0.0, 0.0})});
  CHECK(segment::segment(row, {}, Options{}, Context{}).parts.size() == 3);
  const segment::Segmentation s = tied(row);
  check_cover(row, s);
  CHECK(s.parts.size() == 1);
  CHECK(s.parts[PartId(0)].hull_volume == Approx(3.02).epsilon(1e-3));
}

TEST_CASE("Tied components whose union is concave stay parts of their own") {
  const mesh::Surface balls =
      test::together({test::sphere(32, 16), moved(test::sphere(32, 16), {2.5, 0.0, 0.0})});
  const segment::Segmentation s = tied(balls);
  check_cover(balls, s);
  CHECK(s.parts.size() == 2);
  // An L of bars that run through each other where they meet.
  const auto bar = [](Vec3 size) {
    return test::mapped(test::voxels({{0, 0, 0}}, 8), [size](Vec3 p) {
      return Vec3{size.x * p.x, size.y * p.y, size.z * p.z};
    });
  };
  const mesh::Surface corner = test::together({bar({4.0, 1.0, 1.0}), bar({0.98, 4.0, 0.99})});
  const segment::Segmentation bent = tied(corner);
  check_cover(corner, bent);
  CHECK(bent.parts.size() >= 2);
  CHECK(bent.parts.size() <= 3);
}

TEST_CASE("A single component is the same, tied or not") {
  const mesh::Surface surface = test::dumbbell();
  const segment::Segmentation apart = segment::segment(surface, {}, Options{}, Context{});
  const segment::Segmentation together = tied(surface);
  REQUIRE(apart.parts.size() == together.parts.size());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    CHECK(apart.part[f] == together.part[f]);
  }
}

namespace {

// Damaged surfaces: 45 % of the faces removed, holes, crumbs (the paper's figure 15).

mesh::Surface without(const mesh::Surface& whole, const std::function<bool(std::uint32_t)>& missing) {
  std::vector<std::array<VertexId, 3>> corners;
  for (std::uint32_t f = 0; f < whole.face_count(); ++f) {
    if (!missing(f)) {
      corners.push_back(whole.vertices(FaceId(f)));
    }
  }
  return {{whole.points().begin(), whole.points().end()}, std::move(corners)};
}

mesh::Surface damaged(const mesh::Surface& whole, double share, std::uint64_t seed) {
  Random random(seed);
  return without(whole, [&](std::uint32_t) { return random.unit() < share; });
}

std::size_t parts(const mesh::Surface& surface, segment::Options::Holes holes) {
  segment::Options options;
  options.holes = holes;
  const auto s = segment::segment(surface, {}, options, Context{});
  // Every face is in one part that says so, virtual facets are in none.
  std::size_t faces = 0;
  for (const PartId p : ids<PartId>(s.parts.size())) {
    REQUIRE(!s.parts[p].faces.empty());
    for (const FaceId f : s.parts[p].faces) {
      REQUIRE(s.part[f] == p);
    }
    faces += s.parts[p].faces.size();
    CHECK(s.parts[p].concavity <= options.concavity);
  }
  CHECK(faces == surface.face_count());
  return s.parts.size();
}

}  // namespace

TEST_CASE("With 45 % of its faces gone a shape has at most twice its parts, crumbs counted") {
  using Holes = segment::Options::Holes;
  const std::vector<mesh::Surface> shapes{test::dumbbell(), test::spiked_sphere(6, 0.02, 120, 60),
                                          test::sphere(100, 50), test::torus(1.0, 0.3, 32, 80)};
  for (const mesh::Surface& whole : shapes) {
    const std::size_t undamaged = parts(whole, Holes::automatic);
    for (const std::uint64_t seed : {1U, 2U}) {
      const mesh::Surface broken = damaged(whole, 0.45, seed);
      CHECK(segment::looks_damaged(broken));
      CHECK(parts(broken, Holes::automatic) <= 2 * undamaged);
    }
    // That is worth something: without closing holes there are hundreds.
    CHECK(parts(damaged(whole, 0.45, 1), Holes::keep) > 20 * undamaged);
  }
}

TEST_CASE("Few holes don't divide a part, and large openings stay open") {
  using Holes = segment::Options::Holes;
  const mesh::Surface ball = test::sphere(48, 24);
  CHECK_FALSE(segment::looks_damaged(ball));
  const mesh::Surface pierced = without(ball, [](std::uint32_t f) { return f % 37 == 0; });
  CHECK_FALSE(segment::looks_damaged(pierced));
  CHECK(parts(pierced, Holes::close) == 1);
  segment::ScaledSurface closed = segment::scale_surface(pierced, {});
  segment::close_holes(closed);
  for (const auto& beside : closed.neighbors) {
    for (const std::uint32_t g : beside) {
      CHECK(g != no_index);
    }
  }
  // A hemisphere's rim is longer than a hole: nothing is added.
  const mesh::Surface half = without(ball, [&](std::uint32_t f) {
    const auto [a, b, c] = ball.vertices(FaceId(f));
    return ball.point(a).z + ball.point(b).z + ball.point(c).z > 0.0;
  });
  segment::ScaledSurface open = segment::scale_surface(half, {});
  segment::close_holes(open);
  CHECK(open.facet_count() == half.face_count());
}

TEST_CASE("A crumb that follows others takes along what followed it") {
  // A sheet; at its corner a crumb of one face, on that one of two, on that another of one. The second has no
  // larger neighbour, and waits until the first is part of the sheet; the third has joined it before.
  constexpr std::uint32_t side = 10;
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners;
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    corners.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      points.push_back({0.1 * x, 0.1 * y, 0.0});
      if (x < side && y < side) {
        const std::uint32_t v = y * (side + 1) + x;
        face(v, v + 1, v + side + 2);
        face(v, v + side + 2, v + side + 1);
      }
    }
  }
  const auto last = static_cast<std::uint32_t>(points.size() - 1);
  for (const Vec3 p :
       {Vec3{1.02, 1.01, 0.0}, Vec3{1.01, 1.02, 0.0}, Vec3{1.03, 1.02, 0.0}, Vec3{1.03, 1.03, 0.0},
        Vec3{1.02, 1.03, 0.0}, Vec3{1.05, 1.04, 0.0}, Vec3{1.04, 1.05, 0.0}}) {
    points.push_back(p);
  }
  face(last, last + 1, last + 2);
  face(last + 1, last + 3, last + 4);
  face(last + 1, last + 4, last + 5);
  face(last + 4, last + 6, last + 7);
  const mesh::Surface sheet(points, corners);
  CHECK(parts(sheet, segment::Options::Holes::keep) == 4);
  CHECK(parts(sheet, segment::Options::Holes::close) == 1);
}

TEST_CASE("Neighbours agree after holes are closed, also where fans meet in a vertex") {
  for (const double share : {0.2, 0.45, 0.7}) {
    segment::ScaledSurface s = segment::scale_surface(damaged(test::sphere(40, 20), share, 9), {});
    segment::close_holes(s);
    for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t g = s.neighbors[f][k];
        if (g == no_index) {
          continue;
        }
        REQUIRE(g != f);
        REQUIRE(g < s.facet_count());
        const std::set<std::uint32_t> edge{s.corners[f][k], s.corners[f][(k + 1) % 3]};
        bool back = false;
        for (unsigned j = 0; j < 3; ++j) {
          back = back || (s.neighbors[g][j] == f &&
                          edge == std::set<std::uint32_t>{s.corners[g][j], s.corners[g][(j + 1) % 3]});
        }
        REQUIRE(back);
      }
    }
  }
}

}  // namespace ridgecraft
