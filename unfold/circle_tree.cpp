// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/circle_tree.hpp"

namespace ridgecraft::unfold {

Circle smallest_circle(Vec2 a, Vec2 b, Vec2 c) {
  // On the longest side unless the triangle is acute, then through all three corners.
  const double ab = dot(b - a, b - a);
  const double bc = dot(c - b, c - b);
  const double ca = dot(a - c, a - c);
  const double longest = std::max({ab, bc, ca});
  Circle circle;
  const double doubled = cross(b - a, c - a);
  if (ab + bc + ca <= 2.0 * longest || !(std::abs(doubled) > 0.0)) {
    circle.centre = longest == ab ? 0.5 * (a + b) : longest == bc ? 0.5 * (b + c) : 0.5 * (c + a);
  } else {
    const Vec2 u = b - a;
    const Vec2 v = c - a;
    circle.centre =
        a + Vec2{(v.y * ab - u.y * ca) / (2.0 * doubled), (u.x * ca - v.x * ab) / (2.0 * doubled)};
  }
  for (const Vec2 p : {a, b, c}) {
    circle.radius = std::max(circle.radius, length(p - circle.centre));
  }
  return circle;
}

}  // namespace ridgecraft::unfold
