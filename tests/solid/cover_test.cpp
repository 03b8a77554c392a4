// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls as a set: the whole solid is in them, limits hold, and what is said of them is so.
#include "solid/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/random.hpp"
#include "segment/segment.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"
#include "solid/solid_checks.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using Cells = std::vector<std::array<int, 3>>;

/// Parts by any rule, such as no segmentation makes them: what hulls promise doesn't depend on that.
segment::Segmentation parts_by(const mesh::Surface& surface, const std::function<unsigned(Vec3)>& part_at) {
  std::vector<std::vector<FaceId>> faces(32);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    faces[part_at((1.0 / 3.0) * (surface.point(a) + surface.point(b) + surface.point(c)))].push_back(f);
  }
  segment::Segmentation s;
  s.part.resize(surface.face_count());
  for (auto& list : faces) {
    if (!list.empty()) {
      for (const FaceId f : list) {
        s.part[f] = PartId(s.parts.size());
      }
      segment::Part part;
      part.faces = std::move(list);
      s.parts.push_back(std::move(part));
    }
  }
  return s;
}

/// The side of a box about `middle` that a point of it lies on.
unsigned side_of(Vec3 p, Vec3 middle) {
  const Vec3 d = p - middle;
  const std::array<double, 3> size{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
  const auto axis = static_cast<unsigned>(std::max_element(size.begin(), size.end()) - size.begin());
  return 2 * axis + ((axis == 0 ? d.x : axis == 1 ? d.y : d.z) > 0.0 ? 1U : 0U);
}

bool inside_any(Vec3 p, const std::vector<solid::Body>& bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const solid::Body& body) {
    return test::largest_excess(body, std::array{p}) <= 1e-12;
  });
}

/// Share of random points of a solid, given by cells or by a test, that lie in no body.
double uncovered_share(const Box3& box, const std::function<bool(Vec3)>& in_solid,
                       const std::vector<solid::Body>& bodies) {
  Random random(11);
  std::size_t inside = 0;
  std::size_t uncovered = 0;
  while (inside < 20000) {
    const Vec3 size = box.size();
    const Vec3 p = box.low + Vec3{size.x * random.unit(), size.y * random.unit(), size.z * random.unit()};
    if (in_solid(p)) {
      ++inside;
      uncovered += inside_any(p, bodies) ? 0U : 1U;
    }
  }
  return static_cast<double>(uncovered) / static_cast<double>(inside);
}

std::function<bool(Vec3)> in_cells(const Cells& cells) {
  return [cells](Vec3 p) {
    return std::any_of(cells.begin(), cells.end(), [&](const auto& c) {
      return p.x >= c[0] && p.x <= c[0] + 1 && p.y >= c[1] && p.y <= c[1] + 1 && p.z >= c[2] &&
             p.z <= c[2] + 1;
    });
  };
}

/// A box of 7 x 7 x 5 cells with walls of one cell, without lid.
Cells crate() {
  Cells cells;
  for (int x = 0; x < 7; ++x) {
    for (int y = 0; y < 7; ++y) {
      for (int z = 0; z < 5; ++z) {
        if (x % 6 == 0 || y % 6 == 0 || z == 0) {
          cells.push_back({x, y, z});
        }
      }
    }
  }
  return cells;
}

double union_of_two_volume(const solid::Body& a, const solid::Body& b, const solid::Body& common) {
  return solid::mass_properties(a).volume + solid::mass_properties(b).volume -
         solid::mass_properties(common).volume;
}

solid::Body box_body(Vec3 low, Vec3 high) {
  std::vector<Vec3> corners;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) {
      for (const double z : {low.z, high.z}) {
        corners.push_back({x, y, z});
      }
    }
  }
  return solid::convex_hull(corners, 0.0);
}

/// Boxes as one surface, each for itself.
mesh::Surface surface_of(const std::vector<solid::Body>& bodies) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const solid::Body& body : bodies) {
    const std::size_t first = points.size();
    points.insert(points.end(), body.points.begin(), body.points.end());
    for (const auto& [a, b, c] : body.triangles) {
      faces.push_back({VertexId(first + a), VertexId(first + b), VertexId(first + c)});
    }
  }
  return {points, faces};
}

bool all_enclosed(std::span<const Vec3> points, const std::vector<solid::Body>& bodies) {
  return std::all_of(points.begin(), points.end(), [&](Vec3 p) { return inside_any(p, bodies); });
}

}  // namespace

TEST_CASE("A box whose sides are parts of their own is filled") {
  const mesh::Surface cube = test::voxels({{0, 0, 0}}, 6);
  const auto parts = parts_by(cube, [](Vec3 p) { return side_of(p, {0.5, 0.5, 0.5}); });
  REQUIRE(parts.parts.size() == 6);
  // Without filling the six sides hold next to nothing.
  CHECK(uncovered_share(cube.bounds(), in_cells({{0, 0, 0}}), solid::part_hulls(cube, parts, {}, Context{})) >
        0.99);
  const solid::HullSet set = solid::model_hulls(cube, parts, {}, Context{});
  CHECK(uncovered_share(cube.bounds(), in_cells({{0, 0, 0}}), set.bodies) == 0.0);
  CHECK(set.filling == 1);
  // The flat sides go with what was filled in between: one body is what a box takes.
  CHECK(set.bodies.size() == 1);
  CHECK(solid::mass_properties(set.bodies.front()).volume == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("A round solid in thin patches is filled") {
  const mesh::Surface ball = test::sphere(48, 32);
  for (const unsigned patches : {8U, 24U}) {
    const auto parts = parts_by(ball, [&](Vec3 p) {
      const unsigned octant = (p.x > 0.0 ? 1U : 0U) + (p.y > 0.0 ? 2U : 0U) + (p.z > 0.0 ? 4U : 0U);
      return patches == 8 ? octant : 3 * octant + side_of(p, {}) / 2;
    });
    REQUIRE(parts.parts.size() == patches);
    const solid::HullSet set = solid::model_hulls(ball, parts, {}, Context{});
    CHECK(uncovered_share(
              ball.bounds(), [](Vec3 p) { return length(p) < 0.98; }, set.bodies) <= 1e-3);
    CHECK(set.fit.uncovered <= solid::most_uncovered);
    CHECK(all_enclosed(ball.points(), set.bodies));
  }
}

TEST_CASE("Walls in two skins are filled, and hollows stay open") {
  const Cells cells = crate();
  const mesh::Surface surface = test::voxels(cells, 1);
  // Outer and inner skin are parts of their own, side by side: no part holds both sides of a wall.
  const Vec3 middle{3.5, 3.5, 3.0};
  const auto parts = parts_by(surface, [&](Vec3 p) {
    const bool inner = p.x > 0.5 && p.x < 6.5 && p.y > 0.5 && p.y < 6.5 && p.z > 0.5;
    return side_of({p.x, p.y, p.z + 0.01}, middle) + (inner ? 6U : 0U);
  });
  const double before =
      uncovered_share(surface.bounds(), in_cells(cells), solid::part_hulls(surface, parts, {}, Context{}));
  CHECK(before > 0.1);
  const solid::HullSet set = solid::model_hulls(surface, parts, {}, Context{});
  CHECK(uncovered_share(surface.bounds(), in_cells(cells), set.bodies) <= 1e-3);
  CHECK(all_enclosed(surface.points(), set.bodies));
  // The hollow is 5 x 5 x 4 of 7 x 7 x 5 cells: a body across it would be seen at once.
  CHECK(set.fit.union_volume < 1.25 * set.fit.solid_volume);
}

TEST_CASE("What hulls leave uncovered is measured") {
  // Three boxes, of which one has no hull: shares are exact.
  const std::vector<solid::Body> boxes{box_body({0, 0, 0}, {2, 1, 1}), box_body({3, 0, 0}, {4, 1, 1}),
                                       box_body({5, 0, 0}, {6, 1, 2})};
  const mesh::Surface surface = surface_of(boxes);
  const solid::Fit fit = solid::fit_of(surface, {boxes[0], boxes[2]}, Context{});
  CHECK(fit.solid_volume == Approx(5.0).epsilon(0.01));
  CHECK(fit.uncovered == Approx(0.2).epsilon(0.01));
  // Overlapping hulls count once.
  const std::vector<solid::Body> crossing{box_body({0, 0, 0}, {2, 1, 1}), box_body({1, 0, 0}, {4, 1, 1})};
  CHECK(solid::fit_of(surface, crossing, Context{}).union_volume == Approx(4.0).epsilon(0.01));
  // A surface with a border encloses nothing that is known.
  const mesh::Surface open = test::revolve({{1.0, 0.0}, {1.0, 2.0}}, 12);
  CHECK(solid::fit_of(open, boxes, Context{}).solid_volume == 0.0);
  const auto parts = segment::segment(open, {}, {}, Context{});
  CHECK(solid::model_hulls(open, parts, {}, Context{}).fit.solid_volume == 0.0);
}

TEST_CASE("At most so many hulls with at most so many vertices, and all is enclosed") {
  Cells cells = crate();
  cells.push_back({9, 9, 0});  // apart from the others
  const mesh::Surface surface = test::voxels(cells, 2);
  const auto parts = parts_by(surface, [&](Vec3 p) {
    return p.x > 8.0 ? 12U : side_of({p.x, p.y, p.z + 0.01}, {3.5, 3.5, 3.0});
  });
  REQUIRE(parts.parts.size() > 5);
  double before = INFINITY;
  for (const std::size_t limit : {1U, 2U, 3U, 5U, 8U}) {
    for (const std::size_t vertices : {0U, 8U, 60U}) {
      const solid::HullSet set =
          solid::model_hulls(surface, parts, {.max_vertices = vertices, .max_hulls = limit}, Context{});
      CHECK(set.bodies.size() <= limit);
      CHECK(all_enclosed(surface.points(), set.bodies));
      CHECK(uncovered_share(surface.bounds(), in_cells(cells), set.bodies) <= 1e-3);
      for (const solid::Body& body : set.bodies) {
        CHECK(test::closed_and_manifold(body));
        CHECK((vertices == 0 || body.points.size() <= vertices));
      }
      if (vertices == 0) {
        CHECK(set.fit.union_volume <= before * 1.001);  // more hulls never fit worse here
        before = set.fit.union_volume;
      }
    }
  }
}

TEST_CASE("The error of limits that is said is the one that is made") {
  const mesh::Surface ball = test::sphere(40, 30);
  const auto parts = segment::segment(ball, {}, {}, Context{});
  for (const std::size_t vertices : {8U, 20U, 60U}) {
    const solid::HullSet set = solid::model_hulls(ball, parts, {.max_vertices = vertices}, Context{});
    REQUIRE(set.bodies.size() == 1);
    CHECK(set.fit.union_volume / set.fit.solid_volume ==
          Approx(solid::mass_properties(set.bodies.front()).volume /
                 solid::mass_properties(ball, Context{})->volume)
              .epsilon(0.005));
  }
}

TEST_CASE("Mass and inertia are the model's, not those of its hulls") {
  const mesh::Surface l = test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, 0, 2}}, 1);
  const solid::MassProperties mass = *solid::mass_properties(l, Context{});
  CHECK(mass.volume == Approx(5.0));
  CHECK(mass.center.x == Approx((3 * 0.5 + 1.5 + 2.5) / 5.0));
  // What is thin is exact, too: rays would hardly meet it.
  const mesh::Surface rods =
      surface_of({box_body({0, 0, 0}, {1000, 1, 0.3}), box_body({0, 5, 0}, {1000, 6, 0.3})});
  CHECK(solid::mass_properties(rods, Context{})->volume == Approx(600.0));
  // Two boxes that share a third of each: their space counts once.
  const std::vector<solid::Body> crossing{box_body({0, 0, 0}, {3, 1, 1}), box_body({2, 0, 0}, {5, 1, 1})};
  const solid::MassProperties both = *solid::mass_properties(surface_of(crossing), Context{});
  const solid::MassProperties whole = solid::mass_properties(box_body({0, 0, 0}, {5, 1, 1}));
  CHECK(both.volume ==
        Approx(union_of_two_volume(crossing[0], crossing[1], box_body({2, 0, 0}, {3, 1, 1}))).epsilon(0.01));
  CHECK(length(both.center - whole.center) < 0.01);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(both.inertia[i] == Approx(whole.inertia[i]).epsilon(0.02));
  }
  CHECK(solid::union_properties(crossing, Context{}).volume == Approx(5.0).epsilon(0.01));
  CHECK_FALSE(solid::mass_properties(test::revolve({{1.0, 0.0}, {1.0, 2.0}}, 12), Context{}).has_value());
}

TEST_CASE("The hull of many points stops when it is told to") {
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 60000; ++i) {
    points.push_back(normalized(Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5}));
  }
  StopSource source;
  Context context;
  context.stop = source.get_token();
  const solid::Body hull = solid::convex_hull(points, 0.0, context);
  CHECK(hull.points.size() > 59000);
  source.request_stop();
  CHECK_THROWS_AS(solid::convex_hull(points, 0.0, context), Error);
}

}  // namespace ridgecraft
