// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/pocket_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgecraft::segment {
namespace {

/// Depth beyond the tolerance that is rounding, in radii of the ball.
constexpr double depth_rounding = 1e-9;
/// How far beside a facet air is looked for, in radii: far above the grid, far below any feature.
constexpr double beside = 1e-7;
/// Direction of rays, along no likely edge or face.
constexpr Vec3 ray{0.43201637, 0.28905123, 0.85429631};

}  // namespace

PocketTest::PocketTest(const ScaledSurface& surface, double tolerance)
    : surface_(&surface), tolerance_(tolerance), air_(surface.facet_count(), -1) {}

bool PocketTest::encloses(const ScaledSurface& surface) {
  return std::all_of(surface.neighbors.begin(), surface.neighbors.end(), [](const auto& beside_facet) {
    return std::find(beside_facet.begin(), beside_facet.end(), none) == beside_facet.end();
  });
}

int PocketTest::winding(Vec3 point) const {
  int number = 0;
  const auto& points = surface_->points;
  for (const auto& [i, j, k] : surface_->corners) {
    const Vec3 a = points[i] - point;
    const Vec3 b = points[j] - point;
    const Vec3 c = points[k] - point;
    const double u = dot(ray, cross(b, c));
    const double v = dot(ray, cross(c, a));
    const double w = dot(ray, cross(a, b));
    const bool out = u > 0.0 && v > 0.0 && w > 0.0;
    const bool in = u < 0.0 && v < 0.0 && w < 0.0;
    if ((out || in) && dot(a, cross(b, c)) * (u + v + w) > 0.0) {
      number += out ? 1 : -1;
    }
  }
  return number;
}

void PocketTest::find_planes(const Hull& hull) {
  find_hull_planes(hull, surface_->points, hull_planes_);
  planes_.clear();
  for (const HullPlane& plane : hull_planes_) {
    planes_.push_back({plane.normal, plane.offset - tolerance_ - depth_rounding});
  }
}

/// Whether a facet has a point inside all planes. `last`: the plane that turned the facet before away.
bool PocketTest::reaches_in(std::uint32_t facet, std::size_t& last, Vec3& where) const {
  const auto& corners = surface_->corners[facet];
  const auto beyond = [&](const HalfSpace& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return dot(plane.normal, surface_->points[v]) >= plane.offset;
    });
  };
  if (beyond(planes_[last])) {
    return false;
  }
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    if (beyond(planes_[i])) {
      last = i;
      return false;
    }
  }
  std::vector<Vec3> polygon;
  for (const std::uint32_t v : corners) {
    polygon.push_back(surface_->points[v]);
  }
  std::vector<Vec3> cut;
  for (const HalfSpace& plane : planes_) {
    cut.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 p = polygon[i];
      const Vec3 q = polygon[(i + 1) % polygon.size()];
      const double at_p = dot(plane.normal, p) - plane.offset;
      const double at_q = dot(plane.normal, q) - plane.offset;
      if (at_p < 0.0) {
        cut.push_back(p);
      }
      if ((at_p < 0.0) != (at_q < 0.0)) {
        cut.push_back(p + (at_p / (at_p - at_q)) * (q - p));
      }
    }
    polygon.swap(cut);
    if (polygon.empty()) {
      return false;
    }
  }
  where = Vec3{};
  for (const Vec3 p : polygon) {
    where += p / static_cast<double>(polygon.size());
  }
  return true;
}

bool PocketTest::has_air_beside(std::uint32_t facet, Vec3 where) {
  std::int8_t& known = air_[facet];
  if (known < 0) {
    const Vec3 n = surface_->facet_normal(facet);
    known = n == Vec3{} ? std::int8_t{0}
                        : static_cast<std::int8_t>(winding(where + beside * n) == 0 ||
                                                   winding(where - beside * n) == 0);
  }
  return known == 1;
}

bool PocketTest::has_pocket(const Hull& hull) {
  if (hull.flat || hull.triangles.empty()) {
    return false;
  }
  find_planes(hull);
  const auto deepest = deepest_point(planes_);
  if (!deepest || deepest->depth <= 0.0) {
    return false;
  }
  if (winding(deepest->point) == 0) {
    return true;
  }
  std::size_t last = 0;
  Vec3 where;
  for (std::uint32_t f = 0; f < surface_->facet_count(); ++f) {
    if (air_[f] != 0 && reaches_in(f, last, where) && has_air_beside(f, where)) {
      return true;
    }
  }
  return false;
}

}  // namespace ridgecraft::segment
