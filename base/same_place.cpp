// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/same_place.hpp"

#include <bit>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

/// 0 and -0 are one place.
std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x + 0.0);
}

std::uint64_t hash(Vec3 p) {
  return Random(Random(Random(bits(p.x)).next() ^ bits(p.y)).next() ^ bits(p.z)).next();
}

}  // namespace

std::vector<std::uint32_t> first_at_place(std::span<const Vec3> points,
                                          std::span<const std::uint8_t> counts) {
  std::vector<std::uint32_t> first(points.size());
  // Open addressing, at most half full. Only whether a point is there is asked, never in which order.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * points.size() + 1), no_index);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    first[i] = i;
    if (!counts.empty() && counts[i] == 0) {
      continue;
    }
    std::size_t slot = hash(points[i]) & (table.size() - 1);
    while (table[slot] != no_index && points[table[slot]] != points[i]) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == no_index) {
      table[slot] = i;
    }
    first[i] = table[slot];
  }
  return first;
}

}  // namespace ridgecraft
