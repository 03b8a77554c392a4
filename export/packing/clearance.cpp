// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/boxes.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::export_ {
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
