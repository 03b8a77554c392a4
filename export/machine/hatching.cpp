// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/hatching.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ridgecraft::export_ {

std::vector<std::array<Vec2, 2>> hatching(const std::vector<Vec2>& polygon, double apart_mm) {
  const Vec2 along{0.5 * std::numbers::sqrt2, 0.5 * std::numbers::sqrt2};
  const Vec2 across = perpendicular(along);
  double low = 1e300;
  double high = -1e300;
  for (const Vec2 p : polygon) {
    low = std::min(low, dot(p, across));
    high = std::max(high, dot(p, across));
  }
  std::vector<std::array<Vec2, 2>> lines;
  for (double k = std::ceil(low / apart_mm); k * apart_mm < high; k += 1.0) {
    const double level = k * apart_mm;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      const double at_a = dot(a, across) - level;
      const double at_b = dot(b, across) - level;
      if ((at_a > 0.0) != (at_b > 0.0)) {
        crossings.push_back(dot(a + (at_a / (at_a - at_b)) * (b - a), along));
      }
    }
    std::ranges::sort(crossings);
    for (std::size_t i = 1; i < crossings.size(); i += 2) {
      lines.push_back({crossings[i - 1] * along + level * across, crossings[i] * along + level * across});
    }
  }
  return lines;
}

}  // namespace ridgecraft::export_
