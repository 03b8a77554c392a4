// SPDX-License-Identifier: GPL-3.0-or-later
// Components that are tied together as one object.
#include "segment/surface/component_ties.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
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
        if (g != segment::none && open.erase(g) == 1) {
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
    count += static_cast<std::size_t>(std::count(neighbors.begin(), neighbors.end(), segment::none));
  }
  return count;
}

/// Neighbours know each other, and of two that share a side each runs through it in its own direction.
void check_neighbors(const segment::ScaledSurface& s) {
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == segment::none) {
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

}  // namespace ridgecraft
