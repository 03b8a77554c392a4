// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

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

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

Point at(const Body& body, Index i) {
  const Vec3 p = body.points[i];
  return {p.x, p.y, p.z};
}

Index opposite(const Triangle& t, Index a, Index b) {
  return *std::find_if(t.begin(), t.end(), [&](Index v) { return v != a && v != b; });
}

/// Number of the flat side that each triangle lies in.
std::vector<Index> sides_of(const Body& hull, const std::map<std::pair<Index, Index>, Index>& left_of) {
  std::vector<bool> flat;  // without area, so that it lies in many planes
  for (const auto& [a, b, c] : hull.triangles) {
    flat.push_back(CGAL::collinear(at(hull, a), at(hull, b), at(hull, c)));
  }
  DisjointSets sets(hull.triangles.size());
  for (const auto& [edge, f] : left_of) {
    const auto [a, b] = edge;
    const Index g = left_of.at({b, a});
    if (!flat[f] && !flat[g] &&
        CGAL::coplanar(at(hull, a), at(hull, b), at(hull, opposite(hull.triangles[f], a, b)),
                       at(hull, opposite(hull.triangles[g], a, b)))) {
      sets.join(f, g);
    }
  }
  // A triangle without area goes to the side beyond its longest edge.
  for (Index f = 0; f < hull.triangles.size(); ++f) {
    if (flat[f]) {
      const Triangle& t = hull.triangles[f];
      const auto size = [&](std::size_t k) {
        return length(hull.points[t[(k + 1) % 3]] - hull.points[t[k]]);
      };
      const std::size_t longest = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
      sets.join(f, left_of.at({t[(longest + 1) % 3], t[longest]}));
    }
  }
  std::vector<Index> side;
  for (Index f = 0; f < hull.triangles.size(); ++f) {
    side.push_back(sets.find(f));
  }
  return side;
}

/// The corners around each side, from the least one.
std::vector<std::vector<Index>> loops_of(const Body& hull, const std::vector<bool>& is_corner,
                                         const std::map<std::pair<Index, Index>, Index>& left_of,
                                         const std::vector<Index>& side) {
  std::map<std::pair<Index, Index>, Index> next;  // by side and point
  for (const auto& [edge, f] : left_of) {
    if (side[f] != side[left_of.at({edge.second, edge.first})]) {
      next[{side[f], edge.first}] = edge.second;
    }
  }
  std::vector<std::vector<Index>> loops;
  Index done = no_index;
  for (const auto& entry : next) {
    const auto [s, start] = entry.first;
    if (s == done) {
      continue;
    }
    done = s;
    std::vector<Index> loop;
    Index v = start;
    for (std::size_t steps = 0; steps < hull.points.size() && (steps == 0 || v != start); ++steps) {
      if (is_corner[v]) {
        loop.push_back(v);
      }
      v = next.at({s, v});
    }
    loops.push_back(std::move(loop));
  }
  return loops;
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

Body canonical_hull(const Body& hull) {
  std::map<std::pair<Index, Index>, Index> left_of;
  for (Index f = 0; f < hull.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      left_of[{hull.triangles[f][k], hull.triangles[f][(k + 1) % 3]}] = f;
    }
  }
  const std::vector<Index> side = sides_of(hull, left_of);
  std::vector<std::set<Index>> sides_at(hull.points.size());
  for (const auto& [edge, f] : left_of) {
    sides_at[edge.first].insert(side[f]);
  }
  std::vector<Index> corners;
  std::vector<bool> is_corner;
  for (Index v = 0; v < hull.points.size(); ++v) {
    // Two sides meet in an edge, three in a corner.
    is_corner.push_back(sides_at[v].size() >= 3);
    if (is_corner.back()) {
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
  for (std::vector<Index>& loop : loops_of(hull, is_corner, left_of, side)) {
    for (Index& v : loop) {
      v = number[v];
    }
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      result.triangles.push_back({loop[0], loop[i], loop[i + 1]});
    }
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace ridgecraft::solid
