// SPDX-License-Identifier: GPL-3.0-or-later
// Small convex polygons of the plane that allocate nothing: clipping, distance, width.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft::unfold {

/// The side of a line: points x with dot(normal, x) >= offset. The normal has length 1.
struct HalfPlane {
  Vec2 normal;
  double offset = 0.0;
};

/// A convex polygon, counterclockwise, of at most 12 corners; two corners are a segment, none is nothing.
class ConvexShape {
 public:
  static constexpr std::uint32_t capacity = 12;

  ConvexShape() = default;
  ConvexShape(std::initializer_list<Vec2> corners);
  explicit ConvexShape(std::span<const Vec2> corners);

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] Vec2 operator[](std::uint32_t i) const { return corners_[i]; }
  [[nodiscard]] Vec2& operator[](std::uint32_t i) { return corners_[i]; }
  [[nodiscard]] const Vec2* begin() const { return corners_.data(); }
  [[nodiscard]] const Vec2* end() const { return corners_.data() + size_; }

  /// Adds a corner; beyond the capacity the shape becomes empty, the safe side for whoever wants room.
  void push_back(Vec2 p);
  [[nodiscard]] double area() const;
  [[nodiscard]] Box2 box() const;

 private:
  std::array<Vec2, capacity> corners_{};
  std::uint32_t size_ = 0;
  bool overflown_ = false;
};

/// The part of the shape on the kept side.
[[nodiscard]] ConvexShape clipped(const ConvexShape& shape, const HalfPlane& keep);

/// Largest gap along a normal of either shape's sides: the distance of the shapes or less where they are
/// apart, minus the shortest translation that separates them where they overlap (unfolding notes,
/// section 2.1).
[[nodiscard]] double separation(const ConvexShape& a, const ConvexShape& b);

/// Are the shapes at least `clearance` apart? With 0 or less, may they touch, penetrating by rounding at
/// most?
[[nodiscard]] bool apart(const ConvexShape& a, const ConvexShape& b, double clearance);

/// From x to x.
struct Span {
  double from = 0.0;
  double to = 0.0;
};
/// The shape's cut with the horizontal line at height y; from > to outside.
[[nodiscard]] Span span_at(const ConvexShape& shape, double y);

/// Length of the shape's cut with the horizontal line at height y; 0 outside.
[[nodiscard]] double width_at(const ConvexShape& shape, double y);

/// Penetration by less than this is touching, mm: rounding, four decades below what the contract allows.
inline constexpr double touching_mm = 1e-7;

// How far a tab keeps from faces and other tabs: the one rule, whatever the shapes are made of.

/// Near a corner of its base a tab comes close to its neighbours inevitably: those that share the corner keep
/// the clearance from this height upwards only, mm.
inline constexpr double corner_zone_mm = 1.0;

/// The part of a tab that keeps the clearance from what shares a corner of its base; empty where the tab is
/// lower. In the frame of shapes.hpp.
[[nodiscard]] inline ConvexShape above_corner_zone(const ConvexShape& tab) {
  return clipped(tab, {{0.0, 1.0}, corner_zone_mm});
}

/// Does a tab keep `clearance_mm` from a face or a tab? Both are asked whether they are at least `least` mm
/// apart (negative: they may touch): whole_apart(least) of the whole shapes; upper_apart(least), only where
/// they share a corner of the base, of the tab above the corner zone and, if the other is a tab, of its part
/// above its own.
///
/// Two forms of shapes are asked, and differ on purpose: the tabs of the result are polygons of any form
/// whose distance is exact (apart), while a search asks for thousands of quadrilaterals with ready normals
/// and gives away what two near corners would leave (walls_apart). What the second calls clear is clear for
/// the first.
template <class WholeApart, class UpperApart>
[[nodiscard]] bool keeps_clear(bool share_corner, double clearance_mm, WholeApart whole_apart,
                               UpperApart upper_apart) {
  if (!share_corner) {
    return whole_apart(clearance_mm);
  }
  return whole_apart(-touching_mm) && upper_apart(clearance_mm);
}

}  // namespace ridgecraft::unfold
