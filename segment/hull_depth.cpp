// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgecraft::segment {
namespace {

/// Cosine below which a normal counts as parallel to a plane.
constexpr double parallel_cosine = 1e-9;
/// A hull facet whose doubled area is below this share of its longest side squared carries no plane (2.5).
constexpr double sliver_share = 1e-7;
/// Difference of normals and offsets up to which two planes are one: rounding, a thousand triangles in a row.
constexpr double same_plane = 1e-10;
constexpr std::size_t lanes = 4;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

HullDepth::HullDepth(const ScaledSurface& surface)
    : surface_(&surface), mark_(surface.vertex_count(), 0), depth_(surface.vertex_count(), 0.0) {}

void HullDepth::select(const Hull& hull) {
  hull_ = &hull;
  planes_known_ = false;
  ++current_;
  for (const std::uint32_t v : hull.vertices) {
    mark_[v] = current_;
    depth_[v] = 0.0;
  }
}

void HullDepth::find_planes() {
  planes_known_ = true;
  x_.clear();
  y_.clear();
  z_.clear();
  offset_.clear();
  const auto& points = surface_->points;
  all_.assign(hull_->triangles.size(), Plane{});
  for (std::uint32_t t = 0; t < all_.size(); ++t) {
    const auto& [a, b, c] = hull_->triangles[t];
    const Vec3 u = points[b] - points[a];
    const Vec3 v = points[c] - points[a];
    const Vec3 w = points[c] - points[b];
    const Vec3 n = cross(u, v);
    const double size = length(n);
    if (size <= sliver_share * std::max({dot(u, u), dot(v, v), dot(w, w)})) {
      continue;
    }
    all_[t] = {n / size, dot(n / size, points[a])};
    if (!continues_neighbor(t)) {
      x_.push_back(all_[t].normal.x);
      y_.push_back(all_[t].normal.y);
      z_.push_back(all_[t].normal.z);
      offset_.push_back(all_[t].offset);
    }
  }
  // Whole groups of lanes: a plane without normal limits nothing.
  while (x_.size() % lanes != 0) {
    x_.push_back(0.0);
    y_.push_back(0.0);
    z_.push_back(0.0);
    offset_.push_back(0.0);
  }
}

/// Whether a triangle lies in the plane of one beside it that came before: one plane of a flat face is
/// enough.
bool HullDepth::continues_neighbor(std::uint32_t t) const {
  for (const std::uint32_t e : hull_->triangle_edges[t]) {
    const auto& [one, two] = hull_->edge_triangles[e];
    const Plane& other = all_[one == t ? two : one];
    if ((one == t ? two : one) < t && length(other.normal - all_[t].normal) < same_plane &&
        std::abs(other.offset - all_[t].offset) < same_plane) {
      return true;
    }
  }
  return false;
}

double HullDepth::along_normal(std::uint32_t v) const {
  const Vec3 p = surface_->points[v];
  const Vec3 n = surface_->vertex_normals[v];
  double best[lanes] = {INFINITY, INFINITY, INFINITY, INFINITY};
  for (std::size_t i = 0; i < x_.size(); i += lanes) {
    for (std::size_t j = 0; j < lanes; ++j) {
      const double cosine = x_[i + j] * n.x + y_[i + j] * n.y + z_[i + j] * n.z;
      const double gap = offset_[i + j] - (x_[i + j] * p.x + y_[i + j] * p.y + z_[i + j] * p.z);
      // Divided first, chosen after: compilers then do all lanes at once.
      const double depth = (gap > 0.0 ? gap : 0.0) / cosine;
      const double limit = cosine > parallel_cosine ? depth : infinite;
      best[j] = limit < best[j] ? limit : best[j];
    }
  }
  return std::min(std::min(best[0], best[1]), std::min(best[2], best[3]));
}

double HullDepth::at(std::uint32_t v) {
  if (mark_[v] != current_) {
    mark_[v] = current_;
    if (hull_->flat || surface_->vertex_normals[v] == Vec3{}) {
      depth_[v] = INFINITY;
    } else {
      if (!planes_known_) {
        find_planes();
      }
      depth_[v] = along_normal(v);
    }
  }
  return depth_[v];
}

}  // namespace ridgecraft::segment
