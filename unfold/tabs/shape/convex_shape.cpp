// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/shape/convex_shape.hpp"

#include <algorithm>
#include <cmath>

#include "base/geometry.hpp"

namespace ridgecraft::unfold {
namespace {

/// Largest gap beyond a side of a; stops early once it exceeds `enough`.
double gap_beyond(const ConvexShape& a, const ConvexShape& b, double enough) {
  double best = -INFINITY;
  for (std::uint32_t i = 0; i < a.size() && best < enough; ++i) {
    const Vec2 along = a[(i + 1) % a.size()] - a[i];
    const double size = length(along);
    if (!(size > 0.0)) {
      continue;
    }
    const Vec2 outward = -perpendicular(along) / size;
    double nearest = INFINITY;
    for (const Vec2 p : b) {
      nearest = std::min(nearest, dot(outward, p - a[i]));
    }
    best = std::max(best, nearest);
  }
  return best;
}

/// Distance of the corners of a from the sides of b.
double corner_distance(const ConvexShape& a, const ConvexShape& b) {
  double best = INFINITY;
  for (const Vec2 p : a) {
    for (std::uint32_t i = 0; i < b.size(); ++i) {
      best = std::min(best, distance_to_segment(p, b[i], b[(i + 1) % b.size()]));
    }
  }
  return best;
}

}  // namespace

ConvexShape::ConvexShape(std::initializer_list<Vec2> corners)
    : ConvexShape(std::span<const Vec2>(corners.begin(), corners.size())) {}

ConvexShape::ConvexShape(std::span<const Vec2> corners) {
  for (const Vec2 p : corners) {
    push_back(p);
  }
}

void ConvexShape::push_back(Vec2 p) {
  if (overflown_ || size_ == capacity) {
    overflown_ = true;
    size_ = 0;
    return;
  }
  corners_[size_++] = p;
}

double ConvexShape::area() const {
  double sum = 0.0;
  for (std::uint32_t i = 1; i + 1 < size_; ++i) {
    sum += cross(corners_[i] - corners_[0], corners_[i + 1] - corners_[0]);
  }
  return 0.5 * sum;
}

Box2 ConvexShape::box() const {
  Box2 box;
  for (const Vec2 p : *this) {
    box.add(p);
  }
  return box;
}

ConvexShape clipped(const ConvexShape& shape, const HalfPlane& keep) {
  ConvexShape result;
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    const Vec2 a = shape[i];
    const Vec2 b = shape[(i + 1) % shape.size()];
    const double da = dot(keep.normal, a) - keep.offset;
    const double db = dot(keep.normal, b) - keep.offset;
    if (da >= 0.0) {
      result.push_back(a);
    }
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      result.push_back(a + da / (da - db) * (b - a));
    }
  }
  return result;
}

double separation(const ConvexShape& a, const ConvexShape& b) {
  return std::max(gap_beyond(a, b, INFINITY), gap_beyond(b, a, INFINITY));
}

bool apart(const ConvexShape& a, const ConvexShape& b, double clearance) {
  const double enough = clearance > 0.0 ? clearance : -touching_mm;
  double gap = gap_beyond(a, b, enough);
  if (gap >= enough) {
    return true;
  }
  gap = std::max(gap, gap_beyond(b, a, enough));
  if (gap >= enough || gap <= 0.0) {
    return gap >= enough;
  }
  // Apart, but nearest with two corners: then the gap along the normals is less than the distance.
  return std::min(corner_distance(a, b), corner_distance(b, a)) >= clearance;
}

Span span_at(const ConvexShape& shape, double y) {
  Span span{INFINITY, -INFINITY};
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    const Vec2 a = shape[i];
    const Vec2 b = shape[(i + 1) % shape.size()];
    if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) {
      continue;
    }
    const double t = a.y == b.y ? 0.0 : (y - a.y) / (b.y - a.y);
    const double x = a.x + t * (b.x - a.x);
    span.from = std::min(span.from, a.y == b.y ? std::min(a.x, b.x) : x);
    span.to = std::max(span.to, a.y == b.y ? std::max(a.x, b.x) : x);
  }
  return span;
}

double width_at(const ConvexShape& shape, double y) {
  const Span span = span_at(shape, y);
  return span.to > span.from ? span.to - span.from : 0.0;
}

}  // namespace ridgecraft::unfold
