// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/shape/candidates.hpp"

#include <algorithm>

#include "base/elementary.hpp"
#include "unfold/tabs/shape/clearance.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

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
