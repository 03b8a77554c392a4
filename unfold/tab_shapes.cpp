// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ridgecraft::unfold {

namespace {

/// Corners nearer than this to a corner of the base are that corner, mm: rounding of the layout.
constexpr double same_place_mm = 1e-6;
/// Share of an area within which a clipped shape counts as unclipped.
constexpr double same_area = 1e-9;

using Kind = Obstacle::Kind;

bool shares_left(Kind kind) {
  return kind == Kind::at_base_left || kind == Kind::at_both;
}
bool shares_right(Kind kind) {
  return kind == Kind::at_base_right || kind == Kind::at_both;
}
bool shares_corner(Kind kind) {
  return shares_left(kind) || shares_right(kind);
}

ConvexShape above(const ConvexShape& shape, double y) {
  return clipped(shape, {{0.0, 1.0}, y});
}
ConvexShape below(const ConvexShape& shape, double y) {
  return clipped(shape, {{0.0, -1.0}, -y});
}

double top_of(const ConvexShape& shape) {
  return shape.box().high.y;
}

double usable_height(const TabOptions& options) {
  return std::fmin(usable_height_mm, options.height_mm);
}

/// How good a shape is while it is being cut back: width at the usable height up to half the edge, then area.
double worth(const ConvexShape& shape) {
  const double base = width_at(shape, 0.0);
  return 100.0 * std::fmin(width_at(shape, usable_height_mm), 0.5 * base) + shape.area();
}

/// Slope (dx per dy) of the steepest line through the left end of the base that keeps `clearance` from point
/// p (given relative to that end) and has it on its left; nothing if there is none.
std::optional<double> slope_past(Vec2 p, double clearance, bool shares) {
  const double r = length(p);
  if (shares && r <= same_place_mm) {
    return -INFINITY;
  }
  if (shares || clearance <= 0.0) {
    if (p.y <= same_place_mm) {
      return p.x > same_place_mm ? std::nullopt : std::optional(-INFINITY);
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
    slope = std::fmax(slope, *s);
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

/// Cuts a pointed or narrow top off, so that it is at least as wide as asked; empty if it is nowhere.
ConvexShape blunted(const ConvexShape& tab, double smallest_top) {
  if (tab.size() < 3) {
    return {};
  }
  std::array<double, ConvexShape::capacity> heights{};
  for (std::uint32_t i = 0; i < tab.size(); ++i) {
    heights[i] = tab[i].y;
  }
  std::sort(heights.begin(), heights.begin() + tab.size(), std::greater<>());
  double y = heights[0];
  double width = width_at(tab, y);
  for (std::uint32_t i = 1; i < tab.size() && width < smallest_top; ++i) {
    const double lower = heights[i];
    const double wider = width_at(tab, lower);
    if (wider >= smallest_top && lower < y) {
      y = lower + (y - lower) * (wider - smallest_top) / (wider - width);
      return y > 0.0 ? below(tab, y) : ConvexShape();
    }
    y = lower;
    width = wider;
  }
  return width >= smallest_top && y > 0.0 ? below(tab, y) : ConvexShape();
}

/// Leaves out corners that lie on their neighbours.
ConvexShape without_double_corners(const ConvexShape& tab) {
  ConvexShape result;
  for (const Vec2 p : tab) {
    if (result.empty() || length(p - result[result.size() - 1]) > same_place_mm) {
      result.push_back(p);
    }
  }
  if (result.size() > 2 && length(result[result.size() - 1] - result[0]) <= same_place_mm) {
    ConvexShape open;
    for (std::uint32_t i = 0; i + 1 < result.size(); ++i) {
      open.push_back(result[i]);
    }
    return open;
  }
  return result;
}

/// The shape in its final form, or empty when it is too small to be a tab.
ConvexShape finished(const ConvexShape& tab, const TabOptions& options) {
  const ConvexShape shape = without_double_corners(blunted(tab, options.smallest_top_mm));
  return shape.size() >= 4 && top_of(shape) >= options.smallest_height_mm ? shape : ConvexShape();
}

/// Shares of the edge where a tab on a part of it begins and ends, the longest first.
constexpr std::array<std::array<double, 2>, 9> parts_of_edge{{{0.15, 1.0},
                                                              {0.0, 0.85},
                                                              {0.3, 1.0},
                                                              {0.0, 0.7},
                                                              {0.15, 0.85},
                                                              {0.5, 1.0},
                                                              {0.0, 0.5},
                                                              {0.25, 0.75},
                                                              {0.3, 0.8}}};

/// A base that doesn't reach a corner of the edge has no corner to share there.
Obstacle without_corners_off_base(const Obstacle& obstacle, const TabBase& base) {
  Obstacle result = obstacle;
  if (shares_corner(obstacle.kind)) {
    const bool left = shares_left(obstacle.kind) && base.left <= same_place_mm;
    const bool right = shares_right(obstacle.kind) && base.right >= base.edge - same_place_mm;
    result.kind =
        left ? (right ? Kind::at_both : Kind::at_base_left) : (right ? Kind::at_base_right : Kind::thing);
  }
  return result;
}

struct Family {
  std::array<double, 3> cotangents;  // as asked, between, steepest
  std::array<double, 3> heights;     // as asked, between, usable
};

Family family(const TabOptions& options) {
  const double low = usable_height(options);
  return {{1.0 / std::tan(options.angle), 1.0 / std::tan(0.5 * (options.angle + options.steepest_angle)),
           1.0 / std::tan(options.steepest_angle)},
          {options.height_mm, 0.5 * (options.height_mm + low), low}};
}

/// `tab` within the trapezoid over its own base.
ConvexShape within(const ConvexShape& tab, double height, double cot_left, double cot_right) {
  const double left = std::sqrt(1.0 + cot_left * cot_left);
  const double right = std::sqrt(1.0 + cot_right * cot_right);
  const Vec2 normal_left{1.0 / left, -cot_left / left};
  const Vec2 normal_right{-1.0 / right, -cot_right / right};
  // The lines pass through the base's ends: a hair of slack keeps those from being lost to rounding.
  ConvexShape result = clipped(tab, {normal_left, dot(normal_left, tab[0]) - 1e-12});
  result = clipped(result, {normal_right, dot(normal_right, tab[1]) - 1e-12});
  return below(result, height);
}

/// Trapezoids of the family that fit wholly inside `largest`.
void add_trapezoids(const ConvexShape& largest, double length, const TabOptions& options,
                    std::vector<TabShape>& shapes) {
  const Family all = family(options);
  for (std::uint32_t steep = 0; steep <= 4; ++steep) {
    for (std::uint32_t h = 0; h < 3; ++h) {
      // Nobody wants a tab that is much higher than wide; the usable height is the least of it.
      if (h > 0 && all.heights[h] >= all.heights[h - 1]) {
        continue;
      }
      if (all.heights[h] > std::fmax(0.5 * length, usable_height(options)) + same_place_mm) {
        continue;
      }
      for (std::uint32_t i = std::min(steep, 2U) + 1; i-- > 0;) {
        if (steep - i > 2) {
          break;
        }
        const ConvexShape whole = trapezoid(largest[0].x, largest[1].x, all.heights[h], all.cotangents[i],
                                            all.cotangents[steep - i]);
        if (whole.empty()) {
          continue;
        }
        const ConvexShape shape =
            within(largest, all.heights[h], all.cotangents[i], all.cotangents[steep - i]);
        if (shape.area() >= whole.area() * (1.0 - same_area) && !finished(whole, options).empty() &&
            top_of(finished(whole, options)) >= all.heights[h] && is_usable(whole, length, options)) {
          shapes.push_back({whole, true, tab_costs.steeper * steep + tab_costs.lower * h});
        }
      }
    }
  }
}

}  // namespace

ConvexShape trapezoid(double left, double right, double height, double cot_left, double cot_right) {
  const Vec2 top_right{right - height * cot_right, height};
  const Vec2 top_left{left + height * cot_left, height};
  if (!(top_left.x < top_right.x)) {
    return {};
  }
  return {{left, 0.0}, {right, 0.0}, top_right, top_left};
}

bool clear_of(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm) {
  if (obstacle.kind == Kind::target_edge) {
    return apart(tab, obstacle.shape, 0.0);
  }
  if (!shares_corner(obstacle.kind)) {
    return apart(tab, obstacle.shape, clearance_mm);
  }
  if (!apart(tab, obstacle.shape, 0.0)) {
    return false;
  }
  const ConvexShape upper = above(tab, corner_zone_mm);
  return upper.empty() || apart(upper, obstacle.shape, clearance_mm);
}

ConvexShape trimmed(const ConvexShape& tab, const Obstacle& obstacle, double clearance_mm) {
  if (tab.empty() || clear_of(tab, obstacle, clearance_mm)) {
    return tab;
  }
  // A hair more than needed, so that rounding doesn't make the result fail the same question.
  const double clearance = obstacle.kind == Kind::target_edge ? 0.0 : clearance_mm + same_place_mm;
  const Cuts cuts = candidate_cuts(tab, obstacle, clearance);
  ConvexShape best;
  double most = 0.0;
  for (std::uint32_t i = 0; i < cuts.count; ++i) {
    const HalfPlane& keep = cuts.lines[i];
    if (dot(keep.normal, tab[0]) < keep.offset - touching_mm ||
        dot(keep.normal, tab[1]) < keep.offset - touching_mm) {
      continue;
    }
    const ConvexShape shape = clipped(tab, {keep.normal, keep.offset - 1e-12});
    const double value = shape.size() < 3 ? 0.0 : worth(shape);
    // The base must come first and whole.
    if (value > most && shape[0] == tab[0] && shape[1] == tab[1] && clear_of(shape, obstacle, clearance_mm)) {
      most = value;
      best = shape;
    }
  }
  return best;
}

ConvexShape largest_tab(const TabBase& base, const std::vector<Obstacle>& obstacles,
                        const TabOptions& options, TabNeed need) {
  const double cot = 1.0 / std::tan(options.steepest_angle);
  const double top = (base.right - base.left - options.smallest_top_mm) / (2.0 * cot);
  const double height = std::fmin(options.height_mm, top);
  if (height < options.smallest_height_mm) {
    return {};
  }
  const auto enough = [&](const ConvexShape& tab) {
    return need == TabNeed::usable ? is_usable(tab, base.edge, options) : !tab.empty();
  };
  ConvexShape tab = trapezoid(base.left, base.right, height, cot, cot);
  for (const Obstacle& obstacle : obstacles) {
    if (!enough(tab)) {
      return {};
    }
    tab = trimmed(tab, without_corners_off_base(obstacle, base), options.clearance_mm);
  }
  return enough(tab) && !finished(tab, options).empty() ? tab : ConvexShape();
}

bool is_usable(const ConvexShape& tab, double length, const TabOptions& options) {
  const double height = usable_height(options);
  if (tab.empty() || top_of(tab) < height - same_place_mm) {
    return false;
  }
  // A hair below the top: turned in the plane and back, a level top isn't quite level.
  return width_at(tab, std::fmin(height, top_of(tab)) - same_place_mm) >= 0.5 * length - same_place_mm;
}

bool long_enough(double length, const TabOptions& options) {
  const double cot = 1.0 / std::tan(options.steepest_angle);
  return length - 2.0 * cot * options.smallest_height_mm >= options.smallest_top_mm;
}

bool long_enough_for_usable(double length, const TabOptions& options) {
  const double cot = 1.0 / std::tan(options.steepest_angle);
  return length - 2.0 * cot * usable_height(options) >= std::fmax(0.5 * length, options.smallest_top_mm);
}

std::vector<TabShape> tab_shapes(const ConvexShape& largest, double length, const TabOptions& options) {
  std::vector<TabShape> shapes;
  if (!is_usable(largest, length, options)) {
    return shapes;
  }
  add_trapezoids(largest, length, options, shapes);
  const auto add = [&](double height, double cot_left, double cot_right, double cost) {
    const ConvexShape shape = finished(within(largest, height, cot_left, cot_right), options);
    if (is_usable(shape, length, options)) {
      shapes.push_back({shape, true, cost});
    }
  };
  const Family all = family(options);
  const double height = std::fmin(options.height_mm, std::fmax(0.5 * length, usable_height(options)));
  for (std::uint32_t i = 0; i < 3; ++i) {
    add(height, all.cotangents[i], all.cotangents[i], tab_costs.trimmed + tab_costs.lower * i);
  }
  // As slanted as a usable tab may be, at one end or at both.
  const double low = usable_height(options);
  const double steep = all.cotangents[2];
  const double spare = (largest[1].x - largest[0].x - 0.5 * length) / low;
  add(low, 0.5 * spare, 0.5 * spare, tab_costs.leaning);
  add(low, spare - steep, steep, tab_costs.leaning);
  add(low, steep, spare - steep, tab_costs.leaning);
  return shapes;
}

std::vector<TabShape> partial_tab_shapes(double length, const std::vector<Obstacle>& obstacles,
                                         const TabOptions& options) {
  std::vector<TabShape> shapes;
  for (const auto& [from, to] : parts_of_edge) {
    const ConvexShape largest =
        largest_tab({from * length, to * length, length}, obstacles, options, TabNeed::usable);
    for (TabShape& shape : tab_shapes(largest, length, options)) {
      shape.cost += tab_costs.part_of_edge + 100.0 * (1.0 - (to - from));
      shapes.push_back(shape);
    }
  }
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const TabShape& a, const TabShape& b) { return a.cost < b.cost; });
  return shapes;
}

TabShape low_tab_shape(double length, const std::vector<Obstacle>& obstacles, const TabOptions& options) {
  TabShape best;
  const auto offer = [&](double from, double to) {
    const ConvexShape shape = finished(
        largest_tab({from * length, to * length, length}, obstacles, options, TabNeed::anything), options);
    if (!shape.empty() && (best.outline.empty() || shape.area() > 1.5 * best.outline.area())) {
      best = {shape, is_usable(shape, length, options), tab_costs.low + 100.0 * (1.0 - (to - from))};
    }
  };
  offer(0.0, 1.0);
  for (const auto& [from, to] : parts_of_edge) {
    if (!best.outline.empty()) {
      break;
    }
    offer(from, to);
  }
  return best;
}

}  // namespace ridgecraft::unfold
