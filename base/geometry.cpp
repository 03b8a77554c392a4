// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/elementary.hpp"

namespace ridgecraft {

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) {
    return points;
  }
  std::vector<Vec2> hull;
  monotone_chain(
      points, [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - b); }, hull);
  return hull;
}

namespace {

/// Slack of the fit, mm where lengths are: far below the contract's 0.001 mm, far above rounding.
constexpr double fit_slack = 1e-7;

/// Hulls with more corners than this are asked by their order: a logarithm of the corners instead of all of
/// them.
constexpr std::size_t most_scanned = 64;

/// How far a convex polygon reaches in any direction.
class HullReach {
 public:
  explicit HullReach(std::span<const Vec2> hull) : hull_(hull) {
    if (hull.size() <= most_scanned) {
      return;
    }
    // Directions of the sides rise by a whole turn on the way around; begun where they jump back.
    std::vector<double> direction(hull.size());
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
      direction[i] = elementary::atan2(side.y, side.x);
    }
    first_ =
        static_cast<std::size_t>(std::min_element(direction.begin(), direction.end()) - direction.begin());
    std::rotate(direction.begin(), direction.begin() + static_cast<std::ptrdiff_t>(first_), direction.end());
    directions_ = std::move(direction);
  }

  /// The greatest product of a corner with this vector.
  [[nodiscard]] double along(Vec2 u) const {
    double farthest = -INFINITY;
    if (directions_.empty()) {
      for (const Vec2 p : hull_) {
        farthest = std::max(farthest, dot(u, p));
      }
      return farthest;
    }
    // At the farthest corner the sides turn from running along u to running against it: a quarter turn from
    // u. Its neighbours are looked at, too, since directions of short sides are rounded.
    const double across = elementary::atan2(u.x, -u.y);
    const std::size_t n = hull_.size();
    const auto side = static_cast<std::size_t>(
        std::lower_bound(directions_.begin(), directions_.end(), across) - directions_.begin());
    for (std::size_t k = side + n - 2; k <= side + n + 2; ++k) {
      farthest = std::max(farthest, dot(u, hull_[(k + first_) % n]));
    }
    return farthest;
  }

 private:
  std::span<const Vec2> hull_;
  std::vector<double>
      directions_;  ///< of its sides from side first_ on, ascending; empty where it is scanned
  std::size_t first_ = 0;
};

bool fits_at(const HullReach& reach, double angle, const Rectangle& rectangle) {
  const Vec2 u{elementary::cos(angle), -elementary::sin(angle)};
  const Vec2 v = perpendicular(u);
  return reach.along(u) + reach.along(-u) <= rectangle.width + fit_slack &&
         reach.along(v) + reach.along(-v) <= rectangle.height + fit_slack;
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

std::optional<double> angle_to_fit(std::span<const Vec2> hull, const Rectangle& rectangle) {
  constexpr double quarter = std::numbers::pi / 2.0;
  const HullReach reach(hull);
  for (const double angle : {0.0, quarter}) {
    if (fits_at(reach, angle, rectangle)) {
      return angle;
    }
  }
  if (hull.size() < 2) {
    return std::nullopt;
  }
  std::optional<double> found;
  const double diagonal = elementary::hypot(rectangle.width, rectangle.height);
  const auto try_angle = [&](double angle) {
    if (!found && fits_at(reach, angle, rectangle)) {
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
    const double angle = -elementary::atan2(edge.y, edge.x);
    if (try_angle(angle) || try_angle(angle + quarter)) {
      return found;
    }
  }
  any_antipodal(hull, [&](Vec2 d) {
    const double size = length(d);
    const double direction = elementary::atan2(d.y, d.x);
    for (const double side : {rectangle.width, rectangle.height}) {
      if (size < side) {
        continue;
      }
      // Turned so that the extent along x is `side`; with width and height exchanged a quarter turn more.
      const double open = elementary::acos(side / size);
      const double base = side == rectangle.width ? 0.0 : quarter;
      if (try_angle(base - direction + open) || try_angle(base - direction - open)) {
        return true;
      }
    }
    return false;
  });
  return found;
}

}  // namespace ridgecraft
