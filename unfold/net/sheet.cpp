// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgecraft::unfold {
namespace {

/// Slack of the fit, mm: far below the contract's 0.001 mm, far above rounding.
constexpr double fit_slack = 1e-7;

struct Extents {
  double x = 0.0;
  double y = 0.0;
};

Extents extents_at(std::span<const Vec2> hull, double angle) {
  const Vec2 u{std::cos(angle), -std::sin(angle)};
  const Vec2 v = perpendicular(u);
  double low_x = INFINITY;
  double high_x = -INFINITY;
  double low_y = INFINITY;
  double high_y = -INFINITY;
  for (const Vec2 p : hull) {
    const double x = dot(u, p);
    const double y = dot(v, p);
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  }
  return {high_x - low_x, high_y - low_y};
}

bool fits_at(std::span<const Vec2> hull, double angle, const Sheet& sheet) {
  const Extents e = extents_at(hull, angle);
  return e.x <= sheet.width + fit_slack && e.y <= sheet.height + fit_slack;
}

/// Calls use(vector between two corners that parallel supporting lines can touch) for all such pairs
/// (rotating calipers, M. Shamos 1978): the extent in any direction is the length of one of them along it.
template <class Use>
bool any_antipodal(std::span<const Vec2> hull, Use use) {
  const std::size_t m = hull.size();
  std::size_t j = 1;
  for (std::size_t i = 0; i < m; ++i) {
    const Vec2 edge = hull[(i + 1) % m] - hull[i];
    if (use(hull[j % m] - hull[i])) {
      return true;
    }
    while (cross(edge, hull[(j + 1) % m] - hull[j % m]) > 0.0) {
      ++j;
      if (use(hull[j % m] - hull[i])) {
        return true;
      }
    }
    if (use(hull[j % m] - hull[(i + 1) % m])) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Sheet& sheet) {
  constexpr double quarter = std::numbers::pi / 2.0;
  for (const double angle : {0.0, quarter}) {
    if (fits_at(hull, angle, sheet)) {
      return angle;
    }
  }
  if (hull.size() < 2) {
    return std::nullopt;
  }
  std::optional<double> found;
  const double diagonal = std::hypot(sheet.width, sheet.height);
  const auto try_angle = [&](double angle) {
    if (!found && fits_at(hull, angle, sheet)) {
      found = angle;
    }
    return found.has_value();
  };
  // Along an edge first: those turns make the tightest rectangles.
  bool too_long = false;
  any_antipodal(hull, [&](Vec2 d) { return too_long = too_long || length(d) > diagonal + 2.0 * fit_slack; });
  if (too_long) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double angle = -std::atan2(edge.y, edge.x);
    if (try_angle(angle) || try_angle(angle + quarter)) {
      return found;
    }
  }
  any_antipodal(hull, [&](Vec2 d) {
    const double size = length(d);
    const double direction = std::atan2(d.y, d.x);
    for (const double side : {sheet.width, sheet.height}) {
      if (size < side) {
        continue;
      }
      // Turned so that the extent along x is `side`; with width and height exchanged a quarter turn more.
      const double open = std::acos(side / size);
      const double base = side == sheet.width ? 0.0 : quarter;
      if (try_angle(base - direction + open) || try_angle(base - direction - open)) {
        return true;
      }
    }
    return false;
  });
  return found;
}

}  // namespace ridgecraft::unfold
