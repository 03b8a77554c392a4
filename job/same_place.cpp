// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/same_place.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ridgecraft::job {
namespace {

/// Rounding lies between points of one model at two sizes, as a share of its largest extent.
constexpr double same_point_share = 1e-4;
/// As many points tell which way is the best.
constexpr std::size_t most_tried = 500;

std::vector<Vec3> some_of(std::span<const Vec3> points) {
  const std::size_t step = points.size() / most_tried + 1;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < points.size(); i += step) {
    some.push_back(points[i]);
  }
  return some;
}

/// Each axis has its box's low or its high side in place.
std::vector<Similarity> ways_between(const Box3& there, const Box3& here) {
  std::vector<double> factors{here.largest_extent() / there.largest_extent()};
  const Vec3 a = there.size();
  const Vec3 b = here.size();
  for (const auto& [old_extent, new_extent] :
       {std::pair(a.x, b.x), std::pair(a.y, b.y), std::pair(a.z, b.z)}) {
    if (old_extent > 0.0 && new_extent > 0.0) {
      factors.push_back(new_extent / old_extent);
    }
  }
  std::vector<Similarity> ways;
  for (const double factor : factors) {
    for (unsigned high = 0; high < 8; ++high) {
      const auto side = [high](const Box3& box) {
        return Vec3{(high & 1U) != 0 ? box.high.x : box.low.x, (high & 2U) != 0 ? box.high.y : box.low.y,
                    (high & 4U) != 0 ? box.high.z : box.low.z};
      };
      ways.push_back({side(there), side(here), factor});
    }
  }
  return ways;
}

}  // namespace

PointSet::PointSet(const mesh::Surface& surface, double share)
    : size_(share * surface.bounds().largest_extent()) {
  for (const Vec3 p : surface.points()) {
    cells_.insert(cell_of(p));
  }
}

PointSet::Cell PointSet::cell_of(Vec3 p) const {
  return {std::llround(p.x / size_), std::llround(p.y / size_), std::llround(p.z / size_)};
}

bool PointSet::contains(Vec3 p) const {
  const auto [x, y, z] = cell_of(p);
  for (std::int64_t i = 0; i < 27; ++i) {
    if (cells_.count({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1}) != 0) {
      return true;
    }
  }
  return false;
}

double PointSet::share_of(std::span<const Vec3> points) const {
  const auto found = std::count_if(points.begin(), points.end(), [&](Vec3 p) { return contains(p); });
  return static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

Similarity same_place(std::span<const Vec3> points, const mesh::Surface& surface) {
  Box3 there;
  for (const Vec3 p : points) {
    there.add(p);
  }
  const PointSet known(surface, same_point_share);
  const std::vector<Vec3> tried = some_of(points);
  const std::vector<Similarity> ways = ways_between(there, surface.bounds());
  Similarity best = ways.front();
  double most = -1.0;
  for (const Similarity& way : ways) {
    std::vector<Vec3> placed;
    for (const Vec3 p : tried) {
      placed.push_back(way(p));
    }
    // Sums of small errors decide nothing.
    constexpr double better = 0.01;
    if (const double share = known.share_of(placed); share > most + better) {
      most = share;
      best = way;
    }
  }
  return best;
}

}  // namespace ridgecraft::job
