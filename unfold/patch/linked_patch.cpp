// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/linked_patch.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace ridgecraft::unfold {
namespace {

/// How far the first link carries, as a multiple of the surface's extent: nets are seldom that long.
constexpr double first_distance = 8.0;

}  // namespace

LinkedPatch linked_patch(const Patch& patch, std::span<const std::uint32_t> links) {
  RIDGECRAFT_ASSERT(links.size() <= LinkedPatch::most_links);
  LinkedPatch result{patch, patch};
  double distance = first_distance * patch.extent;
  for (const std::uint32_t side : links) {
    const std::uint32_t twin = patch.twin[side];
    result.apart.twin[side] = result.apart.twin[twin] = nothing;
    result.apart.frozen[side] = result.apart.frozen[twin] = 0;
    result.joined.frozen[side] = result.joined.frozen[twin] = 1;
    Rigid& across = result.joined.across[side];
    across.shift += Vec2{distance, 0.0};
    result.joined.across[twin] = across.inverse();
    distance *= 2.0;
  }
  return result;
}

std::vector<std::uint32_t> borders_of_trees(const Patch& patch, std::span<const std::uint32_t> piece) {
  std::vector<std::uint32_t> sides;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && side < twin && patch.frozen[side] == 0 && piece[side / 3] != piece[twin / 3]) {
      sides.push_back(side);
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [&](std::uint32_t s, std::uint32_t t) { return patch.length[s] > patch.length[t]; });
  return sides;
}

}  // namespace ridgecraft::unfold
