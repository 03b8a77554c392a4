// SPDX-License-Identifier: GPL-3.0-or-later
// From where a model is looked at: without perspective, so that equal lengths look equal.
#pragma once

#include "base/vector.hpp"

namespace ridgecraft::export_ {

/// Orthonormal and right-handed: what points to the right, up, and towards the eye.
struct Camera {
  Vec3 right{1.0, 0.0, 0.0};
  Vec3 up{0.0, 1.0, 0.0};
  Vec3 toward{0.0, 0.0, 1.0};

  /// Where a point is seen, in its own unit.
  [[nodiscard]] Vec2 operator()(Vec3 p) const { return {dot(right, p), dot(up, p)}; }
  /// How near it is: larger is nearer.
  [[nodiscard]] double depth(Vec3 p) const { return dot(toward, p); }
};

/// How a model stands: orthogonal unit vectors.
struct Stance {
  Vec3 up{0.0, 1.0, 0.0};
  Vec3 front{0.0, 0.0, 1.0};  ///< from the model to whoever stands before it
};

/// The eye stands before the model, walks round it by `azimuth` to its own right, and looks down by
/// `elevation`; radians.
[[nodiscard]] Camera look_from(const Stance& stance, double azimuth, double elevation);

}  // namespace ridgecraft::export_
