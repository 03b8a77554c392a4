// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/shape/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/elementary.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"

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

namespace {

/// Corners nearer than this to a corner of the base are that corner, mm: rounding of the layout.
constexpr double same_place_mm = 1e-6;
/// A tab may overhang the end of its base by so many times its height, where the face behind it does.
constexpr double widest_cotangent = -4.0;
/// But a low one that would be a needle by no more than its height.
constexpr double widest_cotangent_of_low = -1.0;
/// Share of an area within which a clipped shape counts as unclipped.
constexpr double same_area = 1e-9;

ConvexShape below(const ConvexShape& shape, double y) {
  return clipped(shape, {{0.0, -1.0}, -y});
}

/// The widest that a tab can be on any side.
ConvexShape widest_over(double left, double right, const TabOptions& options) {
  return trapezoid(left, right, options.height_mm, widest_cotangent, widest_cotangent);
}

double top_of(const ConvexShape& shape) {
  return shape.box().high.y;
}

double usable_height(const TabOptions& options) {
  return std::min(usable_height_mm, options.height_mm);
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

/// The narrowest strip between two parallel lines that holds the shape: along one of its sides.
double thickness(const ConvexShape& shape) {
  double least = HUGE_VAL;
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    const Vec2 from = shape[i];
    const Vec2 along = shape[(i + 1) % shape.size()] - from;
    double farthest = 0.0;
    for (const Vec2 p : shape) {
      farthest = std::max(farthest, cross(along, p - from) / length(along));
    }
    least = std::min(least, farthest);
  }
  return least;
}

/// Whether a tab reaches beyond its base by more than it is high, and is so thin that nobody can cut or glue
/// it.
bool is_needle(const ConvexShape& tab, const TabOptions& options) {
  const Box2 box = tab.box();
  const double beyond = std::max(tab[0].x - box.low.x, box.high.x - tab[1].x);
  return beyond > top_of(tab) + same_place_mm && thickness(tab) < usable_height(options);
}

/// The shape without what is too narrow at its top, or empty when it is too small to be a tab on an edge of
/// this length.
ConvexShape large_enough(const ConvexShape& tab, double length, const TabOptions& options) {
  const ConvexShape shape = without_double_corners(blunted(tab, least_top(length, options)));
  return shape.size() >= 4 && top_of(shape) >= options.smallest_height_mm ? shape : ConvexShape();
}

/// The shape in its final form, or empty when it is no tab.
ConvexShape finished(const ConvexShape& tab, double length, const TabOptions& options) {
  const ConvexShape shape = large_enough(tab, length, options);
  return shape.empty() || is_needle(shape, options) ? ConvexShape() : shape;
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
  if (shares_left(obstacle.kind) || shares_right(obstacle.kind)) {
    const bool left = shares_left(obstacle.kind) && base.left <= same_place_mm;
    const bool right = shares_right(obstacle.kind) && base.right >= base.edge - same_place_mm;
    result.kind = kind_sharing(left, right);
  }
  return result;
}

struct Family {
  std::array<double, 3> cotangents;  // as asked, between, steepest
  std::array<double, 3> heights;     // as asked, between, usable
};

Family family(const TabOptions& options) {
  const double low = usable_height(options);
  return {{1.0 / elementary::tan(options.angle),
           1.0 / elementary::tan(0.5 * (options.angle + options.steepest_angle)),
           1.0 / elementary::tan(options.steepest_angle)},
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
      if (all.heights[h] > std::max(0.5 * length, usable_height(options)) + same_place_mm) {
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
        if (shape.area() >= whole.area() * (1.0 - same_area) && !finished(whole, length, options).empty() &&
            top_of(finished(whole, length, options)) >= all.heights[h] && is_usable(whole, length, options)) {
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

ConvexShape largest_tab(const TabBase& base, const std::vector<Obstacle>& obstacles,
                        const TabOptions& options, TabNeed need) {
  if (!long_enough(base.edge, options)) {
    return {};
  }
  const double steep = 1.0 / elementary::tan(options.steepest_angle);
  // Where even the steepest sides leave no top, only upright ones do.
  const double top = (base.right - base.left - least_top(base.edge, options)) / (2.0 * steep);
  const auto enough = [&](const ConvexShape& tab) {
    return need == TabNeed::usable ? is_usable(tab, base.edge, options) : !tab.empty();
  };
  const auto trim = [&](ConvexShape tab) {
    for (const Obstacle& obstacle : obstacles) {
      if (!enough(tab)) {
        return ConvexShape();
      }
      tab = trimmed(tab, without_corners_off_base(obstacle, base), options.clearance_mm);
    }
    return enough(tab) && !large_enough(tab, base.edge, options).empty() ? tab : ConvexShape();
  };
  const ConvexShape upright =
      top < options.smallest_height_mm
          ? ConvexShape()
          : trim(trapezoid(base.left, base.right, std::min(options.height_mm, top), steep, steep));
  return upright.empty() ? trim(widest_over(base.left, base.right, options)) : upright;
}

ConvexShape widest_tab(double length, const TabOptions& options) {
  return long_enough(length, options) ? widest_over(0.0, length, options) : ConvexShape();
}

bool is_usable(const ConvexShape& tab, double length, const TabOptions& options) {
  const double height = usable_height(options);
  if (tab.empty() || top_of(tab) < height - same_place_mm) {
    return false;
  }
  // A hair below the top: turned in the plane and back, a level top isn't quite level.
  return width_at(tab, std::min(height, top_of(tab)) - same_place_mm) >= 0.5 * length - same_place_mm;
}

bool long_enough(double length, const TabOptions& options) {
  return length >= least_top(length, options);
}

double least_top(double length, const TabOptions& options) {
  return std::min(options.smallest_top_mm, std::max(0.5 * length, options.narrowest_top_mm));
}

std::vector<TabShape> tab_shapes(const ConvexShape& largest, double length, const TabOptions& options) {
  std::vector<TabShape> shapes;
  if (!is_usable(largest, length, options)) {
    return shapes;
  }
  add_trapezoids(largest, length, options, shapes);
  const auto add = [&](double height, double cot_left, double cot_right, double cost) {
    const ConvexShape shape = finished(within(largest, height, cot_left, cot_right), length, options);
    if (is_usable(shape, length, options)) {
      shapes.push_back({shape, true, cost});
    }
  };
  const Family all = family(options);
  const double height = std::min(options.height_mm, std::max(0.5 * length, usable_height(options)));
  for (std::uint32_t i = 0; i < 3; ++i) {
    add(height, all.cotangents[i], all.cotangents[i], tab_costs.trimmed + tab_costs.lower * i);
  }
  // No more than a usable tab needs, upright or as far to one end as there is room.
  const double low = std::min(usable_height(options), top_of(largest));
  const auto [from, to] = span_at(largest, low);
  const double least = std::min(std::max(0.5 * length, least_top(length, options)), to - from);
  const double middle = 0.5 * (largest[0].x + largest[1].x - least);
  const double upright = std::clamp(middle, from, to - least);
  for (const double left : {upright, from, to - least}) {
    const double cot_left = (left - largest[0].x) / low;
    const double cot_right = (largest[1].x - left - least) / low;
    const double cost =
        tab_costs.leaning + (std::min(cot_left, cot_right) < 0.0 ? tab_costs.overhanging : 0.0);
    if (left == upright) {
      add(height, std::min(cot_left, all.cotangents[2]), std::min(cot_right, all.cotangents[2]), cost - 2.0);
    }
    add(low, cot_left, cot_right, cost);
  }
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
    const ConvexShape largest =
        largest_tab({from * length, to * length, length}, obstacles, options, TabNeed::anything);
    if (largest.empty()) {
      return;
    }
    ConvexShape shape = finished(largest, length, options);
    if (shape.empty()) {
      shape = finished(within(largest, options.height_mm, widest_cotangent_of_low, widest_cotangent_of_low),
                       length, options);
    }
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

namespace {

/// Places of the top between its two ends, as a share of the way, the most upright first.
constexpr std::array<double, 5> places{0.5, 0.25, 0.75, 0.0, 1.0};
/// Ways shorter than this have one place only, mm.
constexpr double shortest_way_mm = 0.2;
/// How far a base that doesn't reach the corners keeps from them, mm: a little more than the clearance.
constexpr double inset_mm = 0.3;

/// The quadrilateral over the base with its top at `height` between the two given x.
TabCandidate candidate(Vec2 base, Vec2 top, double height, double length) {
  TabCandidate result;
  result.whole.corner = {Vec2{base.x, 0.0}, {base.y, 0.0}, {top.y, height}, {top.x, height}};
  const double share = std::min(corner_zone_mm / height, 0.999);
  const Vec2 low = base + share * (top - base);
  result.upper.corner = {
      Vec2{low.x, share * height}, {low.y, share * height}, {top.y, height}, {top.x, height}};
  result.whole.build_walls();
  result.upper.build_walls();
  result.at_left = base.x <= 0.0;
  result.at_right = base.y >= length;
  return result;
}

}  // namespace

std::vector<TabCandidate> tab_candidates(const ConvexShape& largest, double length,
                                         const TabOptions& options) {
  std::vector<TabCandidate> result;
  if (!is_usable(largest, length, options)) {
    return result;
  }
  const double height = std::min(std::min(usable_height_mm, options.height_mm), largest.box().high.y);
  const Span room = span_at(largest, height);
  if (room.to - room.from < least_top(length, options)) {
    return result;
  }
  const double width = std::min(std::max(0.5 * length, least_top(length, options)), room.to - room.from);
  const double way = room.to - width - room.from;
  for (const double place : places) {
    const double left = room.from + place * way;
    result.push_back(candidate({0.0, length}, {left, left + width}, height, length));
    if (way < shortest_way_mm) {
      break;
    }
  }
  // Steep ones on a part of the edge.
  const double steep = height / elementary::tan(options.steepest_angle);
  for (const double place : {0.5, 0.0, 1.0}) {
    const double left =
        std::clamp(room.from + place * way, inset_mm, std::max(inset_mm, length - inset_mm - width));
    if (left + width > length - inset_mm || left < room.from || left + width > room.to) {
      continue;
    }
    const Vec2 base{std::max(left - steep, inset_mm), std::min(left + width + steep, length - inset_mm)};
    result.push_back(candidate(base, {left, left + width}, height, length));
    if (way < shortest_way_mm) {
      break;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
