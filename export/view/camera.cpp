// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/camera.hpp"

#include <cmath>

namespace ridgecraft::paper {

Camera look_from(const Stance& stance, double azimuth, double elevation) {
  const Vec3 side = cross(stance.up, stance.front);
  const Vec3 level = std::cos(azimuth) * stance.front + std::sin(azimuth) * side;
  Camera camera;
  camera.toward = std::cos(elevation) * level + std::sin(elevation) * stance.up;
  camera.right = std::cos(azimuth) * side - std::sin(azimuth) * stance.front;
  camera.up = cross(camera.toward, camera.right);
  return camera;
}

}  // namespace ridgecraft::paper
