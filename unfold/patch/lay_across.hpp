// SPDX-License-Identifier: GPL-3.0-or-later
// What lies beside a side, laid against it.
#pragma once

#include <cmath>

#include "base/geometry.hpp"

namespace ridgecraft::unfold {

/// The neighbour's frame seen from the face's own: the neighbour's side (other_from, other_to) comes to lie
/// on the face's (from, to), turned round. Middles of the sides are matched, so that a difference of lengths
/// by rounding is shared by both ends.
[[nodiscard]] inline Rigid lay_across(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to) {
  const Vec2 along = from - to;
  const Vec2 other = other_to - other_from;
  const double size = length(along) * length(other);
  Rigid r;
  if (size > 0.0) {
    r.cosine = dot(other, along) / size;
    r.sine = cross(other, along) / size;
    const double norm = std::sqrt(r.cosine * r.cosine + r.sine * r.sine);
    r.cosine /= norm;
    r.sine /= norm;
  }
  r.shift = 0.5 * (from + to) - r.turn(0.5 * (other_from + other_to));
  return r;
}

}  // namespace ridgecraft::unfold
