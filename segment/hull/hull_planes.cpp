// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/hull_planes.hpp"

#include <algorithm>

namespace ridgecraft::segment {
namespace {

/// A triangle whose doubled area is below this share of its longest side squared is a sliver.
constexpr double sliver_share = 1e-7;

}  // namespace

bool is_sliver(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = c - b;
  return length(cross(u, v)) <= sliver_share * std::max({dot(u, u), dot(v, v), dot(w, w)});
}

void find_hull_planes(const Hull& hull, std::span<const Vec3> points, std::vector<HullPlane>& planes) {
  planes.clear();
  for (std::uint32_t t = 0; t < hull.triangles.size(); ++t) {
    const auto& [a, b, c] = hull.triangles[t];
    if (is_sliver(points[a], points[b], points[c])) {
      continue;
    }
    const Vec3 outward = cross(points[b] - points[a], points[c] - points[a]);
    const Vec3 normal = outward / length(outward);
    planes.push_back({normal, dot(normal, points[a]), t});
  }
}

}  // namespace ridgecraft::segment
