// SPDX-License-Identifier: GPL-3.0-or-later
// Points and vectors of the plane and of space: two small structs of doubles, and nothing that allocates.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgecraft {

/// A point or vector of the plane.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator-(Vec2 a) {
  return {-a.x, -a.y};
}
constexpr Vec2 operator*(double s, Vec2 a) {
  return {s * a.x, s * a.y};
}
constexpr Vec2 operator*(Vec2 a, double s) {
  return s * a;
}
constexpr Vec2 operator/(Vec2 a, double s) {
  return {a.x / s, a.y / s};
}
constexpr Vec2& operator+=(Vec2& a, Vec2 b) {
  return a = a + b;
}
constexpr Vec2& operator-=(Vec2& a, Vec2 b) {
  return a = a - b;
}
constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// z of the cross product: positive when b lies counterclockwise of a.
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
/// a turned by 90 degrees counterclockwise.
constexpr Vec2 perpendicular(Vec2 a) {
  return {-a.y, a.x};
}
inline double length(Vec2 a) {
  return std::sqrt(dot(a, a));
}

/// A point or vector of space.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
  return s * a;
}
constexpr Vec3 operator/(Vec3 a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
  return a = a + b;
}
constexpr Vec3& operator-=(Vec3& a, Vec3 b) {
  return a = a - b;
}
constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
/// a scaled to length 1; the zero vector stays the zero vector.
inline Vec3 normalized(Vec3 a) {
  const double size = length(a);
  return size > 0.0 ? a / size : Vec3{};
}

/// Axis-parallel box; empty until the first point is added.
struct Box3 {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity};
  Vec3 high{-infinity, -infinity, -infinity};

  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  /// Extent in x, y, z; zero for an empty box.
  [[nodiscard]] Vec3 size() const { return empty() ? Vec3{} : high - low; }
  [[nodiscard]] double diagonal() const { return length(size()); }
  /// The longest side.
  [[nodiscard]] double largest_extent() const {
    const Vec3 extent = size();
    return std::max({extent.x, extent.y, extent.z});
  }
};

/// Axis-parallel rectangle of the plane; empty until the first point is added.
struct Box2 {
  Vec2 low{INFINITY, INFINITY};
  Vec2 high{-INFINITY, -INFINITY};

  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] Vec2 size() const { return empty() ? Vec2{} : high - low; }
};

}  // namespace ridgecraft
