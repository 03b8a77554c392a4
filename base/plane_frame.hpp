// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates within a plane of space.
#pragma once

#include <cmath>

#include "base/vector.hpp"

namespace ridgecraft {

/// Right-handed frame: counterclockwise seen from where the normal points to. Planes across an axis give
/// coordinates without any rounding.
class PlaneFrame {
 public:
  PlaneFrame(Vec3 origin, Vec3 normal) : origin_(origin) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    across_ = normalized(cross(axis, normal));
    up_ = cross(normal, across_);
  }
  /// The point of the plane with these coordinates.
  [[nodiscard]] Vec3 place(Vec2 p) const { return origin_ + p.x * across_ + p.y * up_; }
  [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p - origin_, across_), dot(p - origin_, up_)}; }

 private:
  Vec3 origin_;
  Vec3 across_;
  Vec3 up_;
};

}  // namespace ridgecraft
