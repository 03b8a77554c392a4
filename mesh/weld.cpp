// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace ridgecraft::mesh {
namespace {

bool before(Vec3 a, Vec3 b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

std::size_t join_equal_points(PolygonList& list) {
  std::vector<std::uint8_t> used(list.points.size(), 0);
  for (const std::uint32_t c : list.corners) {
    used[c] = 1;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < list.points.size(); ++i) {
    if (used[i] != 0) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = list.points[a];
    const Vec3 q = list.points[b];
    return before(p, q) || (!before(q, p) && a < b);
  });
  std::vector<std::uint32_t> stays(list.points.size());
  std::iota(stays.begin(), stays.end(), 0U);
  std::size_t gone = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (list.points[order[k]] == list.points[order[k - 1]]) {
      stays[order[k]] = stays[order[k - 1]];
      ++gone;
    }
  }
  if (gone > 0) {
    for (std::uint32_t& c : list.corners) {
      c = stays[c];
    }
  }
  return gone;
}

}  // namespace ridgecraft::mesh
