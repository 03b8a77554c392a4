// SPDX-License-Identifier: GPL-3.0-or-later
// One skin of two bodies against CGAL's own boolean, with exact points.
#include <cmath>
#include <numbers>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include "base/random.hpp"
#include "prepare/skin/skin.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A prism over a star, an L, a comb or a polygon, turned at random: most aren't convex.
mesh::Model random_body(Random& random) {
  std::vector<Vec2> outline;
  switch (random.below(4)) {
    case 0: {
      const std::uint32_t rays = 3 + random.below(4);
      for (std::uint32_t i = 0; i < 2 * rays; ++i) {
        const double r = i % 2 == 0 ? 1.5 : 0.6;
        const double t = std::numbers::pi * i / rays;
        outline.push_back({r * std::cos(t), r * std::sin(t)});
      }
      break;
    }
    case 1:
      outline = {{0, 0}, {2, 0}, {2, 0.7}, {0.7, 0.7}, {0.7, 2}, {0, 2}};
      break;
    case 2:
      outline = {{0, 0},   {3, 0},   {3, 2},     {2.4, 2},   {2.4, 0.6}, {1.8, 0.6},
                 {1.8, 2}, {1.2, 2}, {1.2, 0.6}, {0.6, 0.6}, {0.6, 2},   {0, 2}};
      break;
    default:
      for (std::uint32_t i = 0; i < 7; ++i) {
        const double t = 2.0 * std::numbers::pi * i / 7.0;
        outline.push_back({1.2 * std::cos(t), 1.2 * std::sin(t)});
      }
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces(2);
  const double height = 0.5 + random.unit();
  for (const double z : {-height, height}) {
    for (const Vec2 p : outline) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    faces[0].push_back(n - 1 - i);
    faces[1].push_back(n + i);
    faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  const double a = 7.0 * random.unit();
  const double b = 7.0 * random.unit();
  const Vec3 shift{random.unit(), random.unit(), random.unit()};
  for (Vec3& p : points) {
    p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    p = Vec3{p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)} + shift;
  }
  return test::repaired(test::soup(points, faces));
}

ExactMesh exact(const mesh::Surface& surface) {
  ExactMesh result;
  for (const Vec3 p : surface.points()) {
    result.add_vertex({p.x, p.y, p.z});
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    result.add_face(ExactMesh::Vertex_index(a.value()), ExactMesh::Vertex_index(b.value()),
                    ExactMesh::Vertex_index(c.value()));
  }
  return result;
}

double area_of(const ExactMesh& mesh) {
  double area = 0.0;
  for (const auto f : mesh.faces()) {
    std::vector<Vec3> corners;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const Kernel::Point_3& p = mesh.point(v);
      corners.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    area += 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
  }
  return area;
}

}  // namespace

TEST_CASE("volume and surface of twenty unions are those of CGAL's boolean", "[skin]") {
  Random random(20);
  int united = 0;
  for (int pair = 0; pair < 20; ++pair) {
    INFO("pair " << pair);
    const mesh::Model first = random_body(random);
    const mesh::Model second = random_body(random);
    ExactMesh a = exact(first.surface);
    ExactMesh b = exact(second.surface);
    ExactMesh both;
    REQUIRE(CGAL::Polygon_mesh_processing::corefine_and_compute_union(a, b, both));
    mesh::Soup together = test::soup_of(first.surface);
    const mesh::Soup other = test::soup_of(second.surface);
    const auto offset = static_cast<std::uint32_t>(together.points.size());
    together.points.insert(together.points.end(), other.points.begin(), other.points.end());
    for (const std::uint32_t p : other.corner_point) {
      together.corner_point.push_back(offset + p);
    }
    while (together.first_corner.back() < together.corner_point.size()) {
      together.first_corner.push_back(together.first_corner.back() + 3);
    }
    mesh::Model model = test::repaired(std::move(together));
    const prepare::SkinReport report = prepare::unite_bodies(model, {});
    united += report.united == 2 ? 1 : 0;
    test::check_invariants(model.surface);
    // What nobody can see isn't kept: a cavity between two bodies is a part of CGAL's union.
    if (report.united == 2 && report.united_into == 1) {
      CHECK(test::area(model.surface) == Approx(area_of(both)).epsilon(1e-4));
      CHECK(test::volume(model.surface) ==
            Approx(CGAL::to_double(CGAL::Polygon_mesh_processing::volume(both))).epsilon(1e-4));
    }
  }
  CHECK(united >= 15);
}
