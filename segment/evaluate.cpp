// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/evaluate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/error.hpp"
#include "segment/concavity/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// Half the side of the ray grid: a little more than the ball, so that no hull lies on its rim.
constexpr double grid_reach = 1.001;

struct Interval {
  double low;
  double high;
};

/// Where rays parallel to z meet one convex body.
class Shadow {
 public:
  explicit Shadow(unsigned rays) : rays_(rays), cells_(std::size_t{rays} * rays, {INFINITY, -INFINITY}) {}

  void add_triangle(Vec3 a, Vec3 b, Vec3 c) {
    const double area = cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y});
    if (area == 0.0) {
      return;  // seen edge-on; its neighbours have its border
    }
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const unsigned last_i = cell_after(high_x);
    const unsigned last_j = cell_after(high_y);
    for (unsigned j = cell_after(low_y); j < last_j; ++j) {
      for (unsigned i = cell_after(low_x); i < last_i; ++i) {
        const Vec2 p{center(i), center(j)};
        const double u = cross(Vec2{c.x - b.x, c.y - b.y}, Vec2{p.x - b.x, p.y - b.y}) / area;
        const double v = cross(Vec2{a.x - c.x, a.y - c.y}, Vec2{p.x - c.x, p.y - c.y}) / area;
        const double w = 1.0 - u - v;
        if (u < 0.0 || v < 0.0 || w < 0.0) {
          continue;
        }
        const double z = u * a.z + v * b.z + w * c.z;
        Interval& cell = cells_[std::size_t{j} * rays_ + i];
        cell = {std::min(cell.low, z), std::max(cell.high, z)};
      }
    }
  }
  /// Adds the intervals to the rays' lists.
  void pour(std::vector<std::vector<Interval>>& rays) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].low < cells_[i].high) {
        rays[i].push_back(cells_[i]);
      }
    }
  }

 private:
  [[nodiscard]] double step() const { return 2.0 * grid_reach / rays_; }
  [[nodiscard]] double center(unsigned i) const { return -grid_reach + (i + 0.5) * step(); }
  /// First cell whose centre is at x or beyond.
  [[nodiscard]] unsigned cell_after(double x) const {
    const double at = std::ceil((x + grid_reach) / step() - 0.5);
    return static_cast<unsigned>(std::clamp(at, 0.0, static_cast<double>(rays_)));
  }

  unsigned rays_;
  std::vector<Interval> cells_;
};

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
  std::vector<std::vector<Interval>> along(std::size_t{rays} * rays);
  HullBuilder builder(scaled.points);
  Hull hull;
  for (auto& [part, list] : vertices) {
    context.check();
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    builder.build(list, hull);
    Shadow shadow(rays);
    for (const auto& [a, b, c] : hull.triangles) {
      shadow.add_triangle(scaled.points[a], scaled.points[b], scaled.points[c]);
    }
    shadow.pour(along);
  }
  double sum = 0.0;
  for (auto& intervals : along) {
    sum += union_length(intervals);
  }
  const double cell = 2.0 * grid_reach / rays;
  return sum * cell * cell * scaled.unit * scaled.unit * scaled.unit / enclosed;
}

}  // namespace ridgecraft::segment
