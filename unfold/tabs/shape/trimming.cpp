// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/shape/trimming.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "unfold/tabs/shape/clearance.hpp"

namespace ridgecraft::unfold {

namespace {

/// Of two ways to trim that leave equally much the first is taken, whatever the rounding.
constexpr double clearly_more = 1.0 + 1e-9;

/// Corners nearer than this to a corner of the base are that corner, mm: rounding of the layout.
constexpr double rounding_mm = 1e-6;

using Kind = Obstacle::Kind;

ConvexShape above(const ConvexShape& shape, double y) {
  return clipped(shape, {{0.0, 1.0}, y});
}
/// How good a shape is while it is being cut back: width at the usable height up to half the edge, then area.
double worth(const ConvexShape& shape) {
  const double base = width_at(shape, 0.0);
  return 100.0 * std::min(width_at(shape, usable_height_mm), 0.5 * base) + shape.area();
}

/// Slope (dx per dy) of the steepest line through the left end of the base that keeps `clearance` from point
/// p (given relative to that end) and has it on its left; nothing if there is none.
std::optional<double> slope_past(Vec2 p, double clearance, bool shares) {
  const double r = length(p);
  if (shares && r <= rounding_mm) {
    return -INFINITY;
  }
  if (shares || clearance <= 0.0) {
    if (p.y <= rounding_mm) {
      return p.x > rounding_mm ? std::nullopt : std::optional(-INFINITY);
    }
    // At height corner_zone the line is `clearance` away from the ray to p.
    return (p.x + (shares ? clearance / corner_zone_mm * r : 0.0)) / p.y;
  }
  if (p.y <= clearance) {
    return p.x > -clearance ? std::nullopt : std::optional(-INFINITY);
  }
  return (p.x * p.y + clearance * std::sqrt(r * r - clearance * clearance)) /
         (p.y * p.y - clearance * clearance);
}

/// The half-plane right of the line through the left end of the base that passes the obstacle; `mirrored`
/// does it for the right end.
std::optional<HalfPlane> past_corner(const ConvexShape& obstacle, Vec2 corner, double clearance, bool shares,
                                     bool mirrored) {
  double slope = -INFINITY;
  for (const Vec2 p : obstacle) {
    const Vec2 relative{mirrored ? corner.x - p.x : p.x - corner.x, p.y - corner.y};
    const std::optional<double> s = slope_past(relative, clearance, shares);
    if (!s) {
      return {};
    }
    slope = std::max(slope, *s);
  }
  if (!std::isfinite(slope)) {
    return {};
  }
  const double size = std::sqrt(1.0 + slope * slope);
  const Vec2 normal{(mirrored ? -1.0 : 1.0) / size, -slope / size};
  return HalfPlane{normal, dot(normal, corner)};
}

/// Lines that might separate the tab from the obstacle.
struct Cuts {
  std::array<HalfPlane, ConvexShape::capacity + 3> lines;
  std::uint32_t count = 0;

  void add(const HalfPlane& line) { lines[count++] = line; }
};

Cuts candidate_cuts(const ConvexShape& tab, const Obstacle& obstacle, double clearance) {
  Cuts cuts;
  const ConvexShape& shape = obstacle.shape;
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    const Vec2 along = shape[(i + 1) % shape.size()] - shape[i];
    const double size = length(along);
    if (size > 0.0) {
      const Vec2 outward = -perpendicular(along) / size;
      cuts.add({outward, dot(outward, shape[i]) + clearance});
    }
  }
  const ConvexShape upper = above(shape, 0.0);
  if (upper.empty()) {
    return cuts;
  }
  // Only what lies beside the tab's width limits its height.
  const Box2 box = tab.box();
  const ConvexShape over =
      clipped(clipped(upper, {{1.0, 0.0}, box.low.x - clearance}), {{-1.0, 0.0}, -box.high.x - clearance});
  if (!over.empty()) {
    cuts.add({{0.0, -1.0}, -(over.box().low.y - clearance)});
  }
  if (const auto line = past_corner(upper, tab[0], clearance, shares_left(obstacle.kind), false)) {
    cuts.add(*line);
  }
  if (const auto line = past_corner(upper, tab[1], clearance, shares_right(obstacle.kind), true)) {
    cuts.add(*line);
  }
  return cuts;
}

}  // namespace

bool shares_left(Obstacle::Kind kind) {
  return kind == Kind::at_base_left || kind == Kind::at_both;
}
bool shares_right(Obstacle::Kind kind) {
  return kind == Kind::at_base_right || kind == Kind::at_both;
}
Kind kind_sharing(bool left, bool right) {
  return left ? (right ? Kind::at_both : Kind::at_base_left) : (right ? Kind::at_base_right : Kind::thing);
}

bool clear_of(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm) {
  if (obstacle.kind == Kind::target_edge) {
    return apart(tab, obstacle.shape, 0.0);
  }
  return keeps_clear(
      shares_left(obstacle.kind) || shares_right(obstacle.kind), clearance_mm,
      [&](double least) { return apart(tab, obstacle.shape, least); },
      [&](double least) {
        const ConvexShape upper = above_corner_zone(tab);
        return upper.empty() || apart(upper, obstacle.shape, least);
      });
}

ConvexShape trimmed(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm) {
  if (tab.empty() || clear_of(tab, obstacle, clearance_mm)) {
    return tab;
  }
  // A hair more than needed, so that rounding doesn't make the result fail the same question.
  const double clearance = obstacle.kind == Kind::target_edge ? 0.0 : clearance_mm + rounding_mm;
  const Cuts cuts = candidate_cuts(tab, obstacle, clearance);
  ConvexShape best;
  double most = 0.0;
  for (std::uint32_t i = 0; i < cuts.count; ++i) {
    const HalfPlane& keep = cuts.lines[i];
    if (dot(keep.normal, tab[0]) < keep.offset - rounding_mm ||
        dot(keep.normal, tab[1]) < keep.offset - rounding_mm) {
      continue;
    }
    const ConvexShape shape = clipped(tab, {keep.normal, keep.offset - 1e-12});
    const double value = shape.size() < 3 ? 0.0 : worth(shape);
    // The base must come first and whole.
    if (value > most * clearly_more && shape[0] == tab[0] && shape[1] == tab[1] &&
        clear_of(shape, obstacle, clearance_mm)) {
      most = value;
      best = shape;
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
