// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing_shape.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "mesh/error.hpp"
#include "unfold/sheet.hpp"

namespace ridgecraft::paper {
namespace {

/// A cell that a piece only touches within rounding isn't covered, mm. The gap has room for it.
constexpr double touch = 1e-7;
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
  return {std::cos(angle), std::sin(angle)};
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
      const double direction = std::atan2(d.y, d.x);
      const double open = std::acos(limit / size);
      for (const double angle : {open - direction, -open - direction, std::numbers::pi - open - direction,
                                 std::numbers::pi + open - direction}) {
        angles.push_back(angle + offset);
      }
    }
  }
}

/// Hulls beyond this many corners are thinned out for the search of limits, which is quadratic.
constexpr std::size_t most_hull_corners = 48;

/// Leftmost and rightmost x of a convex polygon, grown by `gap` all round, within the rows y0 .. y1.
struct Reach {
  double low = INFINITY;
  double high = -INFINITY;

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// The part of the segment p q inside the rows.
  void add_clipped(Vec2 p, Vec2 q, double y0, double y1) {
    if (p.y > q.y) {
      std::swap(p, q);
    }
    if (q.y < y0 || p.y > y1) {
      return;
    }
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0.0;
    add(p.y < y0 ? p.x + (y0 - p.y) * slope : p.x);
    add(q.y > y1 ? p.x + (y1 - p.y) * slope : q.x);
  }
};

Reach reach(std::span<const Vec2> polygon, double gap, double y0, double y1) {
  Reach result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i];
    const Vec2 q = polygon[(i + 1) % polygon.size()];
    const Vec2 along = q - p;
    const double size = length(along);
    if (gap == 0.0 || size == 0.0) {
      result.add_clipped(p, q, y0, y1);
    } else {
      // Both sides of the edge: one is the border of the grown polygon, the other lies inside.
      const Vec2 out = (gap / size) * perpendicular(along);
      result.add_clipped(p + out, q + out, y0, y1);
      result.add_clipped(p - out, q - out, y0, y1);
    }
    const double away = std::max({0.0, y0 - p.y, p.y - y1});
    if (away <= gap) {
      const double wide = std::sqrt(gap * gap - away * away);
      result.add(p.x - wide);
      result.add(p.x + wide);
    }
  }
  return result;
}

std::int32_t cell_of(double x, double cell) {
  return static_cast<std::int32_t>(std::floor(x / cell));
}

using Run = Raster::Run;

/// Sorts runs and joins those that meet.
void unite(std::vector<Run>& runs) {
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return a.row != b.row ? a.row < b.row : a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  std::size_t kept = 0;
  for (const Run& run : runs) {
    if (kept > 0 && runs[kept - 1].row == run.row && run.begin <= runs[kept - 1].end) {
      runs[kept - 1].end = std::max(runs[kept - 1].end, run.end);
    } else {
      runs[kept++] = run;
    }
  }
  runs.resize(kept);
}

void cover(std::span<const Vec2> polygon, double cell, double gap, std::vector<Run>& runs) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const Vec2 p : polygon) {
    low = std::min(low, p.y - gap);
    high = std::max(high, p.y + gap);
  }
  const std::int32_t first = cell_of(low + touch, cell);
  const std::int32_t last = std::max(first, cell_of(high - touch, cell));
  for (std::int32_t row = first; row <= last; ++row) {
    const Reach r = reach(polygon, gap, row * cell, (row + 1) * cell);
    if (r.low <= r.high) {
      const std::int32_t begin = cell_of(r.low + touch, cell);
      runs.push_back({row, begin, std::max(begin, cell_of(r.high - touch, cell)) + 1});
    }
  }
}

/// In the order of halving: the longest run, then ever finer steps over the rows, so that the first few say
/// most.
void spread(std::vector<Run>& runs) {
  const auto longest = std::max_element(
      runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.end - a.begin < b.end - b.begin; });
  std::vector<Run> result{*longest};
  runs.erase(longest);
  for (std::size_t step = std::bit_ceil(runs.size() + 1); step >= 2; step /= 2) {
    for (std::size_t i = step / 2; i <= runs.size(); i += step) {
      result.push_back(runs[i - 1]);
    }
  }
  runs = std::move(result);
}

}  // namespace

PackingShape packing_shape(std::vector<std::vector<Vec2>> convex) {
  PackingShape shape;
  std::vector<Vec2> points;
  for (const auto& polygon : convex) {
    shape.area += area_of(polygon);
    points.insert(points.end(), polygon.begin(), polygon.end());
  }
  shape.hull = unfold::convex_hull(std::move(points));
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
    const double level = -std::atan2(side.y, side.x);
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
    const double angle = -std::atan2(side.y, side.x);
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

Raster rasterize(const PackingShape& shape, Turn turn, double cell, double gap) {
  Raster raster;
  raster.turn = turn;
  Box2 box;
  for (const Vec2 p : shape.hull) {
    box.add(turn(p));
  }
  raster.low = box.low;
  raster.size = box.size();
  std::vector<Vec2> turned;
  for (const auto& polygon : shape.convex) {
    turned.clear();
    for (const Vec2 p : polygon) {
      turned.push_back(turn(p) - box.low);
    }
    cover(turned, cell, 0.0, raster.solid);
    cover(turned, cell, gap, raster.padded);
  }
  unite(raster.solid);
  unite(raster.padded);
  spread(raster.solid);
  return raster;
}

}  // namespace ridgecraft::paper
