// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace {

/// Turns nearer than this (radians, 2 degrees) to one already chosen bring nothing new.
constexpr double turn_distance = 2.0 * std::numbers::pi / 180.0;

double area_of(std::span<const Vec2> polygon) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * std::abs(doubled);
}

Turn turn_by(double angle) {
  return {elementary::cos(angle), elementary::sin(angle)};
}

/// Room left in the rectangle, negative where the hull sticks out.
double slack(std::span<const Vec2> hull, Vec2 area, double angle) {
  const Vec2 size = extent(hull, turn_by(angle));
  return std::min(area.x - size.x, area.y - size.y);
}

/// Angles in [0, pi) at which the width of the turned hull equals the limit: the width is |d| |cos(angle +
/// direction of d)| for the antipodal pair d that is widest there, so each pair of corners gives at most two.
void add_limits(std::span<const Vec2> hull, double limit, double offset, std::vector<double>& angles) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const Vec2 d = hull[j] - hull[i];
      const double size = length(d);
      if (size < limit || size <= 0.0) {
        continue;
      }
      const double direction = elementary::atan2(d.y, d.x);
      const double open = elementary::acos(limit / size);
      for (const double angle : {open - direction, -open - direction, std::numbers::pi - open - direction,
                                 std::numbers::pi + open - direction}) {
        angles.push_back(angle + offset);
      }
    }
  }
}

/// Hulls beyond this many corners are thinned out for the search of limits, which is quadratic.
constexpr std::size_t most_hull_corners = 48;

}  // namespace

PackingShape packing_shape(std::vector<std::vector<Vec2>> convex) {
  PackingShape shape;
  std::vector<Vec2> points;
  for (const auto& polygon : convex) {
    shape.area += area_of(polygon);
    points.insert(points.end(), polygon.begin(), polygon.end());
  }
  shape.hull = convex_hull(std::move(points));
  shape.convex = std::move(convex);
  return shape;
}

Vec2 extent(std::span<const Vec2> hull, Turn turn) {
  Box2 box;
  for (const Vec2 p : hull) {
    box.add(turn(p));
  }
  return box.size();
}

std::vector<Turn> fitting_turns(std::span<const Vec2> hull, Vec2 area) {
  std::vector<double> angles{0.0, std::numbers::pi / 2.0};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double level = -elementary::atan2(side.y, side.x);
    angles.push_back(level);
    angles.push_back(level + std::numbers::pi / 2.0);
  }
  if (hull.size() <= most_hull_corners) {
    add_limits(hull, area.x, 0.0, angles);
    // The height is the width after another quarter turn.
    add_limits(hull, area.y, -std::numbers::pi / 2.0, angles);
  } else {
    for (int step = 0; step < 720; ++step) {
      angles.push_back(step * std::numbers::pi / 720.0);
    }
  }
  // Extents repeat after half a turn.
  for (double& angle : angles) {
    angle = std::fmod(std::fmod(angle, std::numbers::pi) + std::numbers::pi, std::numbers::pi);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<std::pair<double, double>> found;  // slack, angle
  for (std::size_t i = 0; i < angles.size(); ++i) {
    // Between two limits the hull may fit with room to spare.
    const double after = i + 1 < angles.size() ? angles[i + 1] : angles[0] + std::numbers::pi;
    for (const double angle : {angles[i], 0.5 * (angles[i] + after)}) {
      const double room = slack(hull, area, angle);
      if (room >= -fit_tolerance_mm) {
        found.emplace_back(room, angle);
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Turn> turns;
  for (const auto& [room, angle] : found) {
    turns.push_back(turn_by(angle));
  }
  return turns;
}

std::vector<Turn> promising_turns(std::span<const Vec2> hull, Vec2 area, std::size_t most) {
  std::vector<std::pair<double, double>> level;  // area of the enclosing rectangle, angle
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double angle = -elementary::atan2(side.y, side.x);
    const Vec2 size = extent(hull, turn_by(angle));
    level.emplace_back(size.x * size.y, angle);
  }
  std::stable_sort(level.begin(), level.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> chosen;
  std::vector<Turn> turns;
  const auto try_angle = [&](double angle) {
    if (turns.size() >= most || slack(hull, area, angle) < -fit_tolerance_mm) {
      return;
    }
    for (const double other : chosen) {
      if (std::abs(std::remainder(angle - other, 2.0 * std::numbers::pi)) < turn_distance) {
        return;
      }
    }
    chosen.push_back(angle);
    turns.push_back(turn_by(angle));
  };
  for (const auto& [size, angle] : level) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      try_angle(angle + quarter * std::numbers::pi / 2.0);
    }
  }
  if (!level.empty()) {
    for (int step = 1; step < 24; ++step) {
      try_angle(level.front().second + step * std::numbers::pi / 12.0);
    }
  }
  if (turns.empty()) {
    for (const Turn& turn : fitting_turns(hull, area)) {
      const Turn half{-turn.cosine, -turn.sine};
      turns.insert(turns.end(), {turn, half});
      if (turns.size() >= most) {
        break;
      }
    }
  }
  return turns;
}

std::vector<Turn> turns_to_try(const PackingShape& shape, Vec2 area, std::size_t most) {
  std::vector<Turn> turns;
  for (const Turn& turn : shape.along_grain) {
    const Vec2 size = extent(shape.hull, turn);
    if (turns.size() < most && size.x <= area.x + fit_tolerance_mm && size.y <= area.y + fit_tolerance_mm) {
      turns.push_back(turn);
    }
  }
  return turns.empty() ? promising_turns(shape.hull, area, most) : turns;
}

namespace {

/// True where a line along a side of `a` has all of `b` beyond it.
bool side_separates(std::span<const Vec2> a, std::span<const Vec2> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 from = a[i];
    const Vec2 normal = perpendicular(a[(i + 1) % a.size()] - from);
    double own = 0.0;
    double low = INFINITY;
    double high = -INFINITY;
    for (const Vec2 p : a) {
      const double at = dot(normal, p - from);
      own = std::abs(at) > std::abs(own) ? at : own;
    }
    for (const Vec2 p : b) {
      const double at = dot(normal, p - from);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    if (own >= 0.0 ? high < 0.0 : low > 0.0) {
      return true;
    }
  }
  return false;
}

}  // namespace

double convex_distance(std::span<const Vec2> a, std::span<const Vec2> b) {
  if (!side_separates(a, b) && !side_separates(b, a)) {
    return 0.0;
  }
  // Apart, so some corner is nearest to some side.
  double nearest = INFINITY;
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    for (const Vec2 p : from) {
      for (std::size_t i = 0; i < to.size(); ++i) {
        nearest = std::min(nearest, distance_to_segment(p, to[i], to[(i + 1) % to.size()]));
      }
    }
  }
  return nearest;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> too_near(const std::vector<OwnedPolygon>& polygons,
                                                              double gap) {
  struct Item {
    Box2 box;
    const OwnedPolygon* polygon;
  };
  std::vector<Item> items;
  for (const OwnedPolygon& polygon : polygons) {
    items.push_back({box_of(polygon.corners), &polygon});
  }
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.box.low.x < b.box.low.x; });
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<const Item*> open;
  for (const Item& item : items) {
    std::erase_if(open, [&](const Item* other) { return other->box.high.x + gap < item.box.low.x; });
    for (const Item* other : open) {
      const std::uint32_t p = item.polygon->owner;
      const std::uint32_t q = other->polygon->owner;
      if (p != q && item.box.low.y < other->box.high.y + gap && other->box.low.y < item.box.high.y + gap &&
          convex_distance(item.polygon->corners, other->polygon->corners) < gap) {
        pairs.emplace(std::min(p, q), std::max(p, q));
      }
    }
    open.push_back(&item);
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace ridgecraft::export_
