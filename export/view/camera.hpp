// SPDX-License-Identifier: GPL-3.0-or-later
// How a model stands, and from where it is seen.
#pragma once

#include "base/vector.hpp"
#include "mesh/model/model.hpp"

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

/// The axis that points up is what the file says. Where it says nothing, it is y or z: what is usual for the
/// format (z for STL, PLY, OFF and 3MF, else y) where the model stands better on it than on the other (on
/// flat ground, or feet that are far apart); the other where it stands much better on that; or else the one
/// across which it isn't mirrored, if it is across the other one and no further one: what has two sides alike
/// has them left and right; or else the one at whose foot the origin lies, in the middle of the model; or
/// else the one along which it is clearly shorter, or what is usual. O(n log n).
[[nodiscard]] mesh::Axis up_axis_of(const mesh::Model& model);

/// That axis, and the front, which looks along z where y is up and against y where z is, as modelling
/// programs have it. O(n log n).
[[nodiscard]] Stance stance_of(const mesh::Model& model);
/// The same where it is known which axis points up.
[[nodiscard]] Stance stance_of(mesh::Axis up);

/// What is how wide (x), deep (y) and high (z) as it stands. O(points).
[[nodiscard]] Vec3 standing_size(const mesh::Surface& surface, const Stance& stance);

}  // namespace ridgecraft::export_
