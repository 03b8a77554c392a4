// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <CGAL/Convex_hull_traits_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/no_index.hpp"
#include "solid/hulls.hpp"

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

using Index = std::uint32_t;

Point at(const Body& body, Index i) {
  const Vec3 p = body.points[i];
  return {p.x, p.y, p.z};
}

/// Work on large hulls asks after so many steps whether to go on.
constexpr std::size_t between_checks = 4096;

/// CGAL makes a plane for each triangle of a hull that it tries: there it can be stopped.
class PatientTraits : public CGAL::Convex_hull_traits_3<Kernel, HullMesh> {
 public:
  explicit PatientTraits(const Context& context) : context_(&context) {}
  Construct_plane_3 construct_plane_3_object() const {
    if (++planes_ % between_checks == 0) {
      context_->check();
    }
    return {};
  }

 private:
  const Context* context_;
  mutable std::size_t planes_ = 0;
};

/// Sides of triangles: side 3 f + k runs from corner k of triangle f to the next one.
Index from(const Body& hull, Index side) {
  return hull.triangles[side / 3][side % 3];
}
Index to(const Body& hull, Index side) {
  return hull.triangles[side / 3][(side + 1) % 3];
}

/// For each side the one that runs back along it. O(n log n).
std::vector<Index> twins_of(const Body& hull) {
  std::vector<std::tuple<Index, Index, Index>> sides;
  for (Index s = 0; s < 3 * hull.triangles.size(); ++s) {
    const auto [low, high] = std::minmax({from(hull, s), to(hull, s)});
    sides.emplace_back(low, high, s);
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Index> twin(sides.size());
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    twin[std::get<2>(sides[i])] = std::get<2>(sides[i + 1]);
    twin[std::get<2>(sides[i + 1])] = std::get<2>(sides[i]);
  }
  return twin;
}

/// Number of the flat face of the hull that each triangle lies in.
std::vector<Index> flat_faces_of(const Body& hull, const std::vector<Index>& twin, const Context& context) {
  std::vector<bool> thin;  // without area, so that it lies in many planes
  for (const auto& [a, b, c] : hull.triangles) {
    thin.push_back(CGAL::collinear(at(hull, a), at(hull, b), at(hull, c)));
  }
  DisjointSets sets(hull.triangles.size());
  for (Index s = 0; s < twin.size(); ++s) {
    if (s % between_checks == 0) {
      context.check();
    }
    const Index f = s / 3;
    const Index g = twin[s] / 3;
    if (s < twin[s] && !thin[f] && !thin[g] &&
        CGAL::coplanar(at(hull, hull.triangles[f][0]), at(hull, hull.triangles[f][1]),
                       at(hull, hull.triangles[f][2]), at(hull, hull.triangles[g][(twin[s] + 2) % 3]))) {
      sets.join(f, g);
    }
  }
  // A triangle without area goes to the face beyond its longest edge.
  for (Index f = 0; f < hull.triangles.size(); ++f) {
    if (thin[f]) {
      const auto size = [&](Index k) {
        return length(hull.points[to(hull, 3 * f + k)] - hull.points[from(hull, 3 * f + k)]);
      };
      const Index longest = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
      sets.join(f, twin[3 * f + longest] / 3);
    }
  }
  std::vector<Index> face;
  for (Index f = 0; f < hull.triangles.size(); ++f) {
    face.push_back(sets.find(f));
  }
  return face;
}

/// Whether three flat faces or more meet at each point: two meet in an edge.
std::vector<bool> corners_of(const Body& hull, const std::vector<Index>& face) {
  std::vector<std::array<Index, 2>> seen(hull.points.size(), {no_index, no_index});
  std::vector<bool> is_corner(hull.points.size(), false);
  for (Index s = 0; s < 3 * hull.triangles.size(); ++s) {
    auto& [one, other] = seen[from(hull, s)];
    const Index f = face[s / 3];
    if (one == no_index) {
      one = f;
    } else if (other == no_index && f != one) {
      other = f;
    } else if (f != one && f != other) {
      is_corner[from(hull, s)] = true;
    }
  }
  return is_corner;
}

/// The corners around each flat face.
std::vector<std::vector<Index>> loops_of(const Body& hull, const std::vector<bool>& is_corner,
                                         const std::vector<Index>& twin, const std::vector<Index>& face) {
  std::vector<std::tuple<Index, Index, Index>> next;  // by face and point
  for (Index s = 0; s < twin.size(); ++s) {
    if (face[s / 3] != face[twin[s] / 3]) {
      next.emplace_back(face[s / 3], from(hull, s), to(hull, s));
    }
  }
  std::sort(next.begin(), next.end());
  std::vector<std::vector<Index>> loops;
  Index done = no_index;
  for (const auto& [f, start, second] : next) {
    if (f == done) {
      continue;
    }
    done = f;
    std::vector<Index> loop;
    Index v = start;
    for (std::size_t steps = 0; steps < hull.points.size() && (steps == 0 || v != start); ++steps) {
      if (is_corner[v]) {
        loop.push_back(v);
      }
      v = std::get<2>(*std::lower_bound(next.begin(), next.end(), std::tuple(f, v, Index{0})));
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

Body convex_hull(std::span<const Vec3> points, double thickness, const Context& context) {
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
  CGAL::convex_hull_3(input.begin(), input.end(), mesh, PatientTraits(context));
  return canonical_hull(body_of(mesh), context);
}

double hull_volume(std::span<const Vec3> points, const Context& context) {
  if (points.size() < 4 || !missing_directions(points).empty()) {
    return 0.0;
  }
  std::vector<Point> input;
  for (const Vec3 p : points) {
    input.push_back(to_cgal(p));
  }
  HullMesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh, PatientTraits(context));
  return std::fabs(mass_properties(body_of(mesh)).volume);
}

bool encloses(const Body& convex, std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [&](Vec3 p) {
    return std::all_of(convex.triangles.begin(), convex.triangles.end(), [&](const auto& t) {
      return CGAL::orientation(to_cgal(convex.points[t[0]]), to_cgal(convex.points[t[1]]),
                               to_cgal(convex.points[t[2]]), to_cgal(p)) != CGAL::POSITIVE;
    });
  });
}

void grow_until_enclosing(Body& convex, std::span<const Vec3> points, const Context& context) {
  Vec3 middle{0.0, 0.0, 0.0};
  for (const Vec3 p : convex.points) {
    middle = middle + (1.0 / static_cast<double>(convex.points.size())) * p;
  }
  for (double growth = 1e-14; !encloses(convex, points); growth *= 4.0) {
    context.check();
    RIDGECRAFT_ASSERT(growth < 0.1);
    for (Vec3& p : convex.points) {
      p = middle + (1.0 + growth) * (p - middle);
    }
    // Rounded corners may leave the faces of a polytope; the hull of what they are now is convex again.
    convex = convex_hull(convex.points, 0.0, context);
  }
}

Body canonical_hull(const Body& hull, const Context& context) {
  const std::vector<Index> twin = twins_of(hull);
  const std::vector<Index> face = flat_faces_of(hull, twin, context);
  const std::vector<bool> is_corner = corners_of(hull, face);
  context.check();
  std::vector<Index> corners;
  for (Index v = 0; v < hull.points.size(); ++v) {
    if (is_corner[v]) {
      corners.push_back(v);
    }
  }
  std::sort(corners.begin(), corners.end(), [&](Index a, Index b) {
    const Vec3 p = hull.points[a];
    const Vec3 q = hull.points[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  Body result;
  std::vector<Index> number(hull.points.size(), no_index);
  for (const Index v : corners) {
    number[v] = static_cast<Index>(result.points.size());
    result.points.push_back(hull.points[v]);
  }
  context.check();
  for (std::vector<Index>& loop : loops_of(hull, is_corner, twin, face)) {
    for (Index& v : loop) {
      v = number[v];
    }
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      result.triangles.push_back({loop[0], loop[i], loop[i + 1]});
    }
  }
  context.check();
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace ridgecraft::solid
