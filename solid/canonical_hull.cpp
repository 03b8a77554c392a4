// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/canonical_hull.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::solid {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

constexpr Index nothing = std::numeric_limits<Index>::max();

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
  Index done = nothing;
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
  std::vector<Index> number(hull.points.size(), nothing);
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
