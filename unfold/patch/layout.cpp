// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/layout.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

Layout lay_out(const Patch& patch, const Folds& folds) {
  const std::uint32_t n = patch.size();
  Layout layout;
  layout.flat.resize(n);
  layout.piece.assign(n, no_index);
  std::vector<Rigid> place(n);
  for (std::uint32_t root = 0; root < n; ++root) {
    if (layout.piece[root] != no_index) {
      continue;
    }
    const auto piece = static_cast<std::uint32_t>(layout.faces.size());
    std::vector<std::uint32_t>& order = layout.faces.emplace_back();
    layout.piece[root] = piece;
    order.push_back(root);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::uint32_t f = order[i];
      for (unsigned k = 0; k < 3; ++k) {
        layout.flat[f][k] = place[f](patch.shape[f][k]);
        const std::uint32_t side = 3 * f + k;
        if (folds[side] == 0) {
          continue;
        }
        RIDGECRAFT_ASSERT(folds[patch.twin[side]] != 0);
        const std::uint32_t g = patch.twin[side] / 3;
        if (layout.piece[g] == no_index) {
          layout.piece[g] = piece;
          place[g] = place[f] * patch.across[side];
          order.push_back(g);
        }
      }
    }
  }
  return layout;
}

bool is_slit(const Patch& patch, const Folds& folds, const Layout& layout, std::uint32_t side) {
  const std::uint32_t twin = patch.twin[side];
  if (twin == no_index || patch.frozen[side] == 0 || folds[side] != 0 ||
      layout.piece[side / 3] != layout.piece[twin / 3]) {
    return false;
  }
  const Triangle& here = layout.flat[side / 3];
  const Triangle& there = layout.flat[twin / 3];
  return length(here[side % 3] - there[(twin % 3 + 1) % 3]) <= closing_tolerance_mm &&
         length(here[(side % 3 + 1) % 3] - there[twin % 3]) <= closing_tolerance_mm;
}

std::vector<Vec2> hull_of(const Layout& layout, std::span<const std::uint32_t> faces) {
  std::vector<Vec2> points;
  points.reserve(3 * faces.size());
  for (const std::uint32_t f : faces) {
    points.insert(points.end(), layout.flat[f].begin(), layout.flat[f].end());
  }
  return convex_hull(std::move(points));
}

namespace {

/// Wider than double, so that the judge's rounding isn't the accused's.
struct Point {
  long double x = 0.0L;
  long double y = 0.0L;
};

long double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<Point> hull_of(std::array<Point, 9> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> hull;
  hull.reserve(12);
  monotone_chain(points, turn, hull);
  return hull;
}

/// Whether the line between the triangles' middles tells that they are apart: most pairs whose boxes meet.
bool plainly_apart(const Triangle& a, const Triangle& b) {
  const Vec2 way = (b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]);
  const double a_far = std::max({dot(way, a[0]), dot(way, a[1]), dot(way, a[2])});
  const double b_near = std::min({dot(way, b[0]), dot(way, b[1]), dot(way, b[2])});
  // No way between two middles that coincide: then nothing is plain.
  return (way.x != 0.0 || way.y != 0.0) && a_far <= b_near;
}

struct Boxed {
  double low_x, high_x, low_y, high_y;
  std::uint32_t index;
};

}  // namespace

double depth_by_difference(const Triangle& a, const Triangle& b) {
  std::array<Point, 9> differences;
  for (std::size_t i = 0; i < 9; ++i) {
    const Vec2 p = a[i / 3];
    const Vec2 q = b[i % 3];
    differences[i] = {static_cast<long double>(p.x) - static_cast<long double>(q.x),
                      static_cast<long double>(p.y) - static_cast<long double>(q.y)};
  }
  const std::vector<Point> hull = hull_of(differences);
  if (hull.size() < 3) {
    return 0.0;  // two parallel segments: nothing to separate
  }
  long double depth = INFINITY;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point& p = hull[i];
    const Point& q = hull[(i + 1) % hull.size()];
    const long double size = std::sqrt((q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y));
    depth = std::min(depth, (p.x * q.y - p.y * q.x) / size);
  }
  return static_cast<double>(depth);
}

std::vector<OverlapFound> find_overlaps(std::span<const Triangle> triangles, double tolerance) {
  std::vector<Boxed> boxes;
  boxes.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    boxes.push_back({low_x, high_x, low_y, high_y, i});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Boxed& a, const Boxed& b) {
    return a.low_x < b.low_x || (a.low_x == b.low_x && a.index < b.index);
  });
  std::vector<OverlapFound> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low_x < boxes[i].high_x; ++j) {
      if (boxes[j].low_y >= boxes[i].high_y || boxes[i].low_y >= boxes[j].high_y) {
        continue;
      }
      const auto [first, second] = std::minmax(boxes[i].index, boxes[j].index);
      if (plainly_apart(triangles[first], triangles[second])) {
        continue;
      }
      const double depth = depth_by_difference(triangles[first], triangles[second]);
      if (depth > tolerance) {
        found.push_back({first, second, depth});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const OverlapFound& a, const OverlapFound& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return found;
}

std::vector<OverlapFound> find_overlaps(const Layout& layout, double tolerance) {
  std::vector<OverlapFound> all;
  std::vector<Triangle> triangles;
  for (const auto& faces : layout.faces) {
    triangles.clear();
    for (const std::uint32_t f : faces) {
      triangles.push_back(layout.flat[f]);
    }
    for (OverlapFound o : find_overlaps(triangles, tolerance)) {
      o.first = faces[o.first];
      o.second = faces[o.second];
      if (o.first > o.second) {
        std::swap(o.first, o.second);
      }
      all.push_back(o);
    }
  }
  return all;
}

}  // namespace ridgecraft::unfold
