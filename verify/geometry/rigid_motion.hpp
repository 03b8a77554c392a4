// SPDX-License-Identifier: GPL-3.0-or-later
// Turns and shifts of space: how nets are folded, and how a folded piece is laid on the model.
#pragma once

#include <array>
#include <span>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// A turn as a unit quaternion w + xi + yj + zk.
struct Turn {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  /// By an angle in radians about a direction of length 1, counterclockwise seen from its tip.
  [[nodiscard]] static Turn about(Vec3 direction, double angle);
  [[nodiscard]] Vec3 operator()(Vec3 p) const;
  /// First b, then a; kept at length 1.
  friend Turn operator*(const Turn& a, const Turn& b);
};

/// p goes to turn(p) + shift.
struct Motion {
  Turn turn;
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
};

/// The motion without mirroring that lays `from` on `to` with the least sum of squared distances (Horn 1987:
/// the turn is the eigenvector to the largest eigenvalue of a symmetric 4 by 4 matrix). As many points in
/// both, at least one.
[[nodiscard]] Motion best_motion(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace ridgecraft::verify
