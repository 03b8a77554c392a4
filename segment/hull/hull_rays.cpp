// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/hull_rays.hpp"

#include <algorithm>

namespace ridgecraft::segment {

double volume_per_length() {
  const double step = RayGrid(rays_a_side).step();
  return step * step;
}

std::vector<RaySpan> cast_rays(const Hull& hull, std::span<const Vec3> points) {
  const RayGrid grid(rays_a_side);
  std::vector<RaySpan> met;
  for (const auto& corners : hull.triangles) {
    const Vec3 a = points[corners[0]];
    const Vec3 b = points[corners[1]];
    const Vec3 c = points[corners[2]];
    grid.for_rays_near(a, b, c, [&](std::uint32_t ray, double u, double v) {
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
        const auto z = static_cast<float>(u * a.z + v * b.z + (1.0 - u - v) * c.z);
        met.push_back({ray, z, z});
      }
    });
  }
  std::sort(met.begin(), met.end(), [](const RaySpan& s, const RaySpan& t) {
    return s.ray != t.ray ? s.ray < t.ray : s.low < t.low;
  });
  std::vector<RaySpan> spans;
  for (const RaySpan& s : met) {
    if (!spans.empty() && spans.back().ray == s.ray) {
      spans.back().high = s.low;
    } else {
      spans.push_back(s);
    }
  }
  return spans;
}

double union_length(std::vector<RaySpan>& spans) {
  std::sort(spans.begin(), spans.end(), [](const RaySpan& s, const RaySpan& t) { return s.low < t.low; });
  double sum = 0.0;
  double reached = -INFINITY;
  for (const RaySpan& s : spans) {
    const auto low = static_cast<double>(s.low);
    const auto high = static_cast<double>(s.high);
    sum += std::max(0.0, high - std::max(low, reached));
    reached = std::max(reached, high);
  }
  return sum;
}

}  // namespace ridgecraft::segment
