// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/judging/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/error.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/hull_rays.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

struct Interval {
  double low;
  double high;
};

/// Adds the intervals in which rays run inside a hull to their lists.
void add_hull(const Hull& hull, std::span<const Vec3> points, const RayGrid& grid,
              std::vector<std::vector<Interval>>& along) {
  std::vector<Interval> inside(grid.cell_count(), {INFINITY, -INFINITY});
  for (const auto& corners : hull.triangles) {
    const Vec3 a = points[corners[0]];
    const Vec3 b = points[corners[1]];
    const Vec3 c = points[corners[2]];
    grid.for_rays_near(a, b, c, [&](std::uint32_t ray, double u, double v) {
      const double w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) {
        return;
      }
      const double z = u * a.z + v * b.z + w * c.z;
      inside[ray] = {std::min(inside[ray].low, z), std::max(inside[ray].high, z)};
    });
  }
  for (std::size_t ray = 0; ray < inside.size(); ++ray) {
    if (inside[ray].low < inside[ray].high) {
      along[ray].push_back(inside[ray]);
    }
  }
}

double union_length(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  double sum = 0.0;
  double reached = -INFINITY;
  for (const Interval& i : intervals) {
    sum += std::max(0.0, i.high - std::max(i.low, reached));
    reached = std::max(reached, i.high);
  }
  return sum;
}

}  // namespace

double enclosed_volume(const mesh::Surface& surface) {
  if (surface.face_count() == 0) {
    return 0.0;
  }
  const Vec3 origin = surface.bounds().low + 0.5 * surface.bounds().size();
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    sum += dot(surface.point(a) - origin, cross(surface.point(b) - origin, surface.point(c) - origin));
  }
  return sum / 6.0;
}

double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label, unsigned rays,
                         const Context& context) {
  RIDGECRAFT_ASSERT(label.size() == surface.face_count());
  const double enclosed = enclosed_volume(surface);
  if (!(enclosed > 0.0)) {
    return 0.0;
  }
  const ScaledSurface scaled = scale_surface(surface, {});
  std::map<std::uint32_t, std::vector<std::uint32_t>> vertices;
  for (std::uint32_t f = 0; f < label.size(); ++f) {
    auto& list = vertices[label[f]];
    list.insert(list.end(), scaled.corners[f].begin(), scaled.corners[f].end());
  }
  const RayGrid grid(rays);
  std::vector<std::vector<Interval>> along(grid.cell_count());
  HullBuilder builder(scaled.points);
  Hull hull;
  for (auto& [part, list] : vertices) {
    context.check();
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    builder.build(list, hull);
    add_hull(hull, scaled.points, grid, along);
  }
  double sum = 0.0;
  for (auto& intervals : along) {
    sum += union_length(intervals);
  }
  return sum * grid.step() * grid.step() * scaled.unit * scaled.unit * scaled.unit / enclosed;
}

}  // namespace ridgecraft::segment
