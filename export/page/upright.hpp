// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that nobody has to read upside down.
#pragma once

#include <numbers>

namespace ridgecraft::export_ {

/// The angle of a text on the same line that is upright as far as possible: in (-90, 90] degrees; a hair
/// below -90 counts as +90, so that vertical texts of a page all read upwards. Radians.
[[nodiscard]] inline double upright(double angle) {
  constexpr double half = 0.5 * std::numbers::pi;
  constexpr double hair = 1e-3;
  while (angle > half + hair) {
    angle -= std::numbers::pi;
  }
  while (angle < -half + hair) {
    angle += std::numbers::pi;
  }
  return angle;
}

}  // namespace ridgecraft::export_
