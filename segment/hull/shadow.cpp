// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/shadow.hpp"

#include <algorithm>

#include "base/convex_hull.hpp"

namespace ridgecraft::segment {
namespace {

/// Twice the area of a triangle, above 0 when it runs counterclockwise.
template <class Spot>
double turn(const Spot& a, const Spot& b, const Spot& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

/// Drops what lies inside the octagon of the points farthest in eight directions: nearly all points of a
/// round shape (Akl and Toussaint 1978).
void Shadow::drop_inner() {
  constexpr std::array<std::array<double, 2>, 8> directions{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Spot, 8> octagon{};
  for (std::size_t d = 0; d < 8; ++d) {
    octagon[d] = *std::max_element(spots_.begin(), spots_.end(), [&](const Spot& p, const Spot& q) {
      return directions[d][0] * p.x + directions[d][1] * p.y <
             directions[d][0] * q.x + directions[d][1] * q.y;
    });
  }
  std::erase_if(spots_, [&](const Spot& p) {
    for (std::size_t d = 0; d < 8; ++d) {
      const Spot& a = octagon[d];
      const Spot& b = octagon[(d + 1) % 8];
      if (a.id != b.id && turn(a, b, p) <= 0.0) {
        return false;
      }
    }
    return true;
  });
}

void Shadow::cast(std::span<const Vec3> points, std::span<const std::uint32_t> ids, Vec3 right, Vec3 up) {
  spots_.clear();
  corners_.clear();
  if (ids.empty()) {
    return;
  }
  for (const std::uint32_t v : ids) {
    spots_.push_back({dot(points[v], right), dot(points[v], up), v});
  }
  drop_inner();
  std::sort(spots_.begin(), spots_.end(), [](const Spot& p, const Spot& q) {
    return p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : p.id < q.id);
  });
  monotone_chain(spots_, turn<Spot>, chain_);
  for (const Spot& spot : chain_) {
    corners_.push_back(spot.id);
  }
}

std::array<std::uint32_t, 2> Shadow::longest(std::span<const Vec3> points) const {
  std::array<std::uint32_t, 2> best{};
  double most = -1.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::uint32_t a = corners_[i];
    const std::uint32_t b = corners_[(i + 1) % corners_.size()];
    if (const double size = length(points[b] - points[a]); size > most) {
      most = size;
      best = {std::min(a, b), std::max(a, b)};
    }
  }
  return best;
}

}  // namespace ridgecraft::segment
