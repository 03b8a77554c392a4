// SPDX-License-Identifier: GPL-3.0-or-later
// How large a view is on its page, and where.
#pragma once

#include "base/vector.hpp"

namespace ridgecraft::paper {

/// From the scene, as the eye has it, to the page.
struct Fit {
  double scale = 1.0;
  Vec2 shift;
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return scale * p + shift; }
};

}  // namespace ridgecraft::paper
