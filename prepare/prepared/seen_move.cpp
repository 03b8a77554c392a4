// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/seen_move.hpp"

#include <algorithm>

namespace ridgecraft::prepare {
namespace {

constexpr double seen_share = 0.03;
constexpr double seen_share_of_thickness = 0.1;
constexpr double least_mm = 1.0;

}  // namespace

SeenMove seen_move(double moved_mm, const Box3& bounds) {
  if (moved_mm > 0.0 && moved_mm >= seen_share * bounds.largest_extent()) {
    return SeenMove::of_size;
  }
  const Vec3 size = bounds.size();
  const double thickness = std::min({size.x, size.y, size.z});
  return thickness >= least_mm && moved_mm >= std::max(least_mm, seen_share_of_thickness * thickness)
             ? SeenMove::of_thickness
             : SeenMove::none;
}

}  // namespace ridgecraft::prepare
