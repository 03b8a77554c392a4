// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/hull_rays.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::segment {
namespace {

/// Half the side of the grid: a little more than the ball.
constexpr double grid_reach = 1.001;
constexpr double ray_step = 2.0 * grid_reach / rays_a_side;

double center(std::uint32_t i) {
  return -grid_reach + (i + 0.5) * ray_step;
}
/// First ray at x or beyond.
std::uint32_t ray_after(double x) {
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil((x + grid_reach) / ray_step - 0.5), 0.0, double{rays_a_side}));
}

}  // namespace

double volume_per_length() {
  return ray_step * ray_step;
}

std::vector<RaySpan> cast_rays(const Hull& hull, std::span<const Vec3> points) {
  std::vector<RaySpan> met;
  for (const auto& corners : hull.triangles) {
    const Vec3 a = points[corners[0]];
    const Vec3 b = points[corners[1]];
    const Vec3 c = points[corners[2]];
    const double area = cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y});
    if (area == 0.0) {
      continue;  // seen edge-on; its neighbours have its border
    }
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const std::uint32_t last_i = ray_after(high_x);
    const std::uint32_t last_j = ray_after(high_y);
    for (std::uint32_t j = ray_after(low_y); j < last_j; ++j) {
      for (std::uint32_t i = ray_after(low_x); i < last_i; ++i) {
        const Vec2 p{center(i), center(j)};
        const double u = cross(Vec2{c.x - b.x, c.y - b.y}, Vec2{p.x - b.x, p.y - b.y}) / area;
        const double v = cross(Vec2{a.x - c.x, a.y - c.y}, Vec2{p.x - c.x, p.y - c.y}) / area;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
          const auto z = static_cast<float>(u * a.z + v * b.z + (1.0 - u - v) * c.z);
          met.push_back({j * rays_a_side + i, z, z});
        }
      }
    }
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
