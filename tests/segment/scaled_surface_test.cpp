// SPDX-License-Identifier: GPL-3.0-or-later
// The segmentation's own numbering, and that of large surfaces as a whole.
#include "segment/surface/scaled_surface.hpp"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "segment/segment.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {

TEST_CASE("Numbered along a curve, a surface is the same one in another order") {
  for (const mesh::Surface& ordered :
       {test::dumbbell(), test::together({test::torus(1.0, 0.3, 16, 40), test::dumbbell()})}) {
    // In any order: that of these shapes runs along rings, so what is near is near already.
    const mesh::Surface s = test::shuffled(ordered, 23);
    std::vector<std::uint32_t> polygon(s.face_count());
    for (std::uint32_t f = 0; f < polygon.size(); ++f) {
      polygon[f] = f / 3;
    }
    const segment::ScaledSurface kept = segment::scale_surface(s, polygon);
    const segment::ScaledSurface curve = segment::scale_surface(s, polygon, segment::Numbering::along_curve);
    REQUIRE(kept.face_of.empty());
    REQUIRE(curve.face_of.size() == s.face_count());
    REQUIRE(curve.vertex_of.size() == s.vertex_count());
    REQUIRE(std::set(curve.face_of.begin(), curve.face_of.end()).size() == s.face_count());
    REQUIRE(std::set(curve.vertex_of.begin(), curve.vertex_of.end()).size() == s.vertex_count());
    double step_kept = 0.0;
    double step_curve = 0.0;
    for (std::uint32_t v = 0; v < s.vertex_count(); ++v) {
      CHECK(curve.points[v] == kept.points[curve.vertex_of[v]]);
      if (v > 0) {
        step_curve += length(curve.points[v] - curve.points[v - 1]);
        step_kept += length(kept.points[v] - kept.points[v - 1]);
      }
    }
    CHECK(step_curve < 0.5 * step_kept);
    for (std::uint32_t f = 0; f < s.face_count(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        CHECK(curve.vertex_of[curve.corners[f][k]] == kept.corners[curve.face_of[f]][k]);
        const std::uint32_t g = curve.neighbors[f][k];
        CHECK((g == segment::none ? g : curve.face_of[g]) == kept.neighbors[curve.face_of[f]][k]);
        CHECK(curve.same_group(f, g == segment::none ? f : g) ==
              kept.same_group(curve.face_of[f], g == segment::none ? curve.face_of[f] : curve.face_of[g]));
      }
    }
  }
}

TEST_CASE("A surface large enough to be renumbered is labelled in its own numbers") {
  const mesh::Surface s = test::spiked_sphere(6, 0.02, 320, 160);
  REQUIRE(s.face_count() > 100000);
  const segment::Segmentation result = segment::segment(s, {}, {0.1}, Context{});
  CHECK(result.parts.size() == 7);
  std::size_t faces = 0;
  for (const PartId p : ids<PartId>(result.parts.size())) {
    const segment::Part& part = result.parts[p];
    CHECK(std::is_sorted(part.faces.begin(), part.faces.end()));
    faces += part.faces.size();
    std::set<VertexId> corners;
    for (const FaceId f : part.faces) {
      CHECK(result.part[f] == p);
      for (const VertexId v : s.vertices(f)) {
        corners.insert(v);
      }
    }
    CHECK(
        std::includes(corners.begin(), corners.end(), part.hull_vertices.begin(), part.hull_vertices.end()));
    if (p.value() > 0) {
      CHECK(result.parts[p].faces.front() > result.parts[PartId(p.value() - 1)].faces.front());
    }
  }
  CHECK(faces == s.face_count());
}

}  // namespace ridgecraft
