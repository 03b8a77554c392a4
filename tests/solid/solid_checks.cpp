// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/solid_checks.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ridgecraft::test {

bool closed_and_manifold(const solid::Body& body) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>>
      around;  // at a vertex: from one neighbour to the next
  for (const auto& t : body.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (a == b || ++sides[{a, b}] > 1) {
        return false;
      }
      around[a][b] = t[(i + 2) % 3];
    }
  }
  for (const auto& [side, count] : sides) {
    if (!sides.contains({side.second, side.first})) {
      return false;
    }
  }
  for (const auto& [vertex, next] : around) {
    std::size_t steps = 1;
    for (std::uint32_t at = next.begin()->second; at != next.begin()->first && steps <= next.size();
         ++steps) {
      at = next.at(at);
    }
    if (steps != next.size()) {
      return false;
    }
  }
  return !body.triangles.empty() && around.size() == body.points.size();
}

double winding_number(const solid::Body& body, Vec3 p) {
  // Solid angle of a triangle: Van Oosterom, Strackee, IEEE Transactions on Biomedical Engineering 30(2),
  // 1983.
  double sum = 0.0;
  for (const auto& t : body.triangles) {
    const Vec3 a = body.points[t[0]] - p;
    const Vec3 b = body.points[t[1]] - p;
    const Vec3 c = body.points[t[2]] - p;
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    sum += 2.0 *
           std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

double largest_excess(const solid::Body& convex, std::span<const Vec3> points) {
  double excess = -INFINITY;
  for (const auto& t : convex.triangles) {
    const Vec3 n =
        cross(convex.points[t[1]] - convex.points[t[0]], convex.points[t[2]] - convex.points[t[0]]);
    for (const Vec3 p : points) {
      excess = std::fmax(excess, dot(normalized(n), p - convex.points[t[0]]));
    }
  }
  return excess;
}

}  // namespace ridgecraft::test
