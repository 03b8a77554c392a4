// SPDX-License-Identifier: GPL-3.0-or-later
// How a model stands, so that pictures show it as people see it.
#pragma once

#include "export/view/camera.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::export_ {

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
