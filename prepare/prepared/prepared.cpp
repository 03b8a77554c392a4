// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/prepared/prepared.hpp"

#include <algorithm>
#include <array>

namespace ridgecraft::prepare {
namespace {

/// Share of the printable area that pieces fill.
constexpr double filled = 0.6;

double area_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    area += surface.area(f);
  }
  return area;
}

}  // namespace

double pages_filled(double area, Vec2 printable) {
  return area / (filled * printable.x * printable.y);
}

double expected_pages(const Prepared& prepared, Vec2 printable) {
  double alone = 0.0;
  double area_of_others = 0.0;
  for (const auto& faces : prepared.panels.faces) {
    const double area = area_of(prepared.model.surface, faces);
    if (area > 0.5 * printable.x * printable.y) {
      alone += 1.0;
    } else {
      area_of_others += area;
    }
  }
  return alone + pages_filled(area_of_others, printable);
}

namespace {

constexpr double seen_fraction = 0.03;
constexpr double seen_share_of_thickness = 0.1;
constexpr double least_mm = 1.0;

}  // namespace

SeenMove seen_move(double moved_mm, const Box3& bounds) {
  if (moved_mm > 0.0 && moved_mm >= seen_fraction * bounds.largest_extent()) {
    return SeenMove::of_size;
  }
  const Vec3 size = bounds.size();
  const double thickness = std::min({size.x, size.y, size.z});
  return thickness >= least_mm && moved_mm >= std::max(least_mm, seen_share_of_thickness * thickness)
             ? SeenMove::of_thickness
             : SeenMove::none;
}

double move_allowed(const Box3& bounds) {
  constexpr double share = 0.1;
  const Vec3 size = bounds.size();
  std::array<double, 3> extents{size.x, size.y, size.z};
  std::sort(extents.begin(), extents.end());
  return share * extents[1];
}

}  // namespace ridgecraft::prepare
