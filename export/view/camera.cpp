// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/camera.hpp"

#include "base/elementary.hpp"

namespace ridgecraft::export_ {

Camera look_from(const Stance& stance, double azimuth, double elevation) {
  const Vec3 side = cross(stance.up, stance.front);
  const Vec3 level = elementary::cos(azimuth) * stance.front + elementary::sin(azimuth) * side;
  Camera camera;
  camera.toward = elementary::cos(elevation) * level + elementary::sin(elevation) * stance.up;
  camera.right = elementary::cos(azimuth) * side - elementary::sin(azimuth) * stance.front;
  camera.up = cross(camera.toward, camera.right);
  return camera;
}

}  // namespace ridgecraft::export_
