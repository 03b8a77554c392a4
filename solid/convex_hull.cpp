// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "base/error.hpp"
#include "solid/body_of.hpp"
#include "solid/canonical_hull.hpp"

namespace ridgecraft::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using HullMesh = CGAL::Surface_mesh<Point>;

Point to_cgal(Vec3 p) {
  return {p.x, p.y, p.z};
}

/// Directions across which points without volume have no extent: three for a point, two for a line, one for a
/// plane, none for a solid. Exact: a set is flat or it isn't.
std::vector<Vec3> missing_directions(std::span<const Vec3> points) {
  const Vec3 a = points.front();
  const auto other = std::find_if(points.begin(), points.end(), [&](Vec3 p) { return !(p == a); });
  if (other == points.end()) {
    return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  }
  // The farthest points make the best conditioned directions.
  const auto farther = [&](Vec3 p, Vec3 q) { return length(p - a) < length(q - a); };
  const Vec3 b = *std::max_element(points.begin(), points.end(), farther);
  const Vec3 along = (1.0 / length(b - a)) * (b - a);
  const auto across = [&](Vec3 p) { return length(cross(along, p - a)); };
  const Vec3 c =
      *std::max_element(points.begin(), points.end(), [&](Vec3 p, Vec3 q) { return across(p) < across(q); });
  if (CGAL::collinear(to_cgal(a), to_cgal(b), to_cgal(c))) {
    const Vec3 axis = std::fabs(along.x) < 0.7 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 u = cross(along, axis);
    const Vec3 unit_u = (1.0 / length(u)) * u;
    return {unit_u, cross(along, unit_u)};
  }
  const bool flat = std::all_of(points.begin(), points.end(), [&](Vec3 p) {
    return CGAL::coplanar(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(p));
  });
  if (!flat) {
    return {};
  }
  const Vec3 n = cross(b - a, c - a);
  return {(1.0 / length(n)) * n};
}

}  // namespace

Body convex_hull(std::span<const Vec3> points, double thickness) {
  RIDGECRAFT_ASSERT(!points.empty());
  std::vector<Point> input;
  for (const Vec3 p : points) {
    input.push_back(to_cgal(p));
  }
  for (const Vec3 direction : missing_directions(points)) {
    const std::size_t count = input.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Kernel::Vector_3 step(thickness * direction.x, thickness * direction.y, thickness * direction.z);
      input.push_back(input[i] + step);
      input.push_back(input[i] - step);
    }
  }
  HullMesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  return canonical_hull(body_of(mesh));
}

bool encloses(const Body& convex, std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [&](Vec3 p) {
    return std::all_of(convex.triangles.begin(), convex.triangles.end(), [&](const auto& t) {
      return CGAL::orientation(to_cgal(convex.points[t[0]]), to_cgal(convex.points[t[1]]),
                               to_cgal(convex.points[t[2]]), to_cgal(p)) != CGAL::POSITIVE;
    });
  });
}

void grow_until_enclosing(Body& convex, std::span<const Vec3> points) {
  Vec3 middle{0.0, 0.0, 0.0};
  for (const Vec3 p : convex.points) {
    middle = middle + (1.0 / static_cast<double>(convex.points.size())) * p;
  }
  for (double growth = 1e-14; !encloses(convex, points); growth *= 4.0) {
    RIDGECRAFT_ASSERT(growth < 0.1);
    for (Vec3& p : convex.points) {
      p = middle + (1.0 + growth) * (p - middle);
    }
    // Rounded corners may leave the faces of a polytope; the hull of what they are now is convex again.
    convex = convex_hull(convex.points, 0.0);
  }
}

}  // namespace ridgecraft::solid
