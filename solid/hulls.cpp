// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "solid/convex_hull.hpp"
#include "solid/enclosing_polytope.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// Half the thickness of a part without volume, as a share of the surface's diagonal: thick enough for the
/// tolerances of physics engines, too thin to be seen.
constexpr double least_thickness = 5e-5;

std::vector<Vec3> part_points(const mesh::Surface& surface, const segment::Part& part) {
  std::vector<VertexId> vertices;
  for (const FaceId f : part.faces) {
    for (const VertexId v : surface.vertices(f)) {
      vertices.push_back(v);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Vec3> points;
  for (const VertexId v : vertices) {
    points.push_back(surface.point(v));
  }
  return points;
}

}  // namespace

std::vector<Body> part_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                             const HullOptions& options, const Context& context) {
  const double thickness = least_thickness * surface.bounds().diagonal();
  std::vector<Body> bodies;
  for (const segment::Part& part : parts.parts) {
    context.check();
    const std::vector<Vec3> points = part_points(surface, part);
    Body hull = convex_hull(points, thickness);
    grow_until_enclosing(hull, points);
    if (options.max_vertices != 0 && hull.points.size() > options.max_vertices) {
      hull = enclosing_polytope(hull, options.max_vertices, context);
    }
    bodies.push_back(std::move(hull));
  }
  return bodies;
}

}  // namespace ridgecraft::solid
