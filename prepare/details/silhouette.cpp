// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/silhouette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr std::size_t cells = 48;

struct Window {
  PlaneFrame frame;
  Vec2 low;
  Vec2 cell;
};

/// One row of cells more all around, which nothing covers.
class Grid {
 public:
  Grid() : covered_(side * side, false) {}

  void cover(std::array<Vec2, 3> p) {
    const double doubled = cross(p[1] - p[0], p[2] - p[0]);
    if (doubled < 0.0) {
      std::swap(p[1], p[2]);
    }
    const auto [left, right] = range(p[0].x, p[1].x, p[2].x);
    const auto [bottom, top] = range(p[0].y, p[1].y, p[2].y);
    for (std::size_t y = bottom; y < top; ++y) {
      for (std::size_t x = left; x < right; ++x) {
        const Vec2 q{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          inside = inside && cross(p[(k + 1) % 3] - p[k], q - p[k]) >= 0.0;
        }
        if (inside) {
          covered_[(y + 1) * side + x + 1] = true;
        }
      }
    }
  }

  /// Cells that are covered, or that no way leads to from outside.
  [[nodiscard]] std::size_t count() const {
    std::vector<bool> outside(covered_.size(), false);
    std::vector<std::size_t> next{0};
    outside[0] = true;
    std::size_t reached = 0;
    while (!next.empty()) {
      const std::size_t at = next.back();
      next.pop_back();
      ++reached;
      const std::size_t x = at % side;
      const std::size_t y = at / side;
      const auto go = [&](bool possible, std::size_t to) {
        if (possible && !covered_[to] && !outside[to]) {
          outside[to] = true;
          next.push_back(to);
        }
      };
      go(x > 0, at - 1);
      go(x + 1 < side, at + 1);
      go(y > 0, at - side);
      go(y + 1 < side, at + side);
    }
    return covered_.size() - reached;
  }

 private:
  static constexpr std::size_t side = cells + 2;

  static std::pair<std::size_t, std::size_t> range(double a, double b, double c) {
    const auto inside = [](double x) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(cells)));
    };
    return {inside(std::floor(std::min({a, b, c}))), inside(std::ceil(std::max({a, b, c})))};
  }

  std::vector<bool> covered_;
};

std::size_t cells_covered(const mesh::Surface& surface, const Window& window) {
  Grid grid;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    std::array<Vec2, 3> corners;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec2 p = window.frame.flat(surface.point(surface.vertices(f)[k])) - window.low;
      corners[k] = {p.x / window.cell.x, p.y / window.cell.y};
    }
    grid.cover(corners);
  }
  return grid.count();
}

}  // namespace

double silhouette_share(const mesh::Surface& body, const mesh::Surface& larger, Vec3 direction) {
  const PlaneFrame frame({}, direction);
  Vec2 low{INFINITY, INFINITY};
  Vec2 high{-INFINITY, -INFINITY};
  for (const Vec3 p : larger.points()) {
    const Vec2 flat = frame.flat(p);
    low = {std::min(low.x, flat.x), std::min(low.y, flat.y)};
    high = {std::max(high.x, flat.x), std::max(high.y, flat.y)};
  }
  const Window window{frame, low, (1.0 / static_cast<double>(cells)) * (high - low)};
  if (!(window.cell.x > 0.0 && window.cell.y > 0.0)) {
    return 0.0;
  }
  const std::size_t all = cells_covered(larger, window);
  return all == 0 ? 0.0 : static_cast<double>(cells_covered(body, window)) / static_cast<double>(all);
}

}  // namespace ridgecraft::prepare
