// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/linked_patch.hpp"

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

}  // namespace ridgecraft::unfold
