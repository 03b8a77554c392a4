// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folded_flat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgecraft::unfold {
namespace {

/// A hundredth of a sheet's thickness, mm, and ten times what single precision leaves of a plane that doesn't
/// lie along the axes: what is thinner is flat.
constexpr double thickness_mm = 1e-3;
constexpr double thickness_share = 1e-6;

}  // namespace

bool is_folded_flat(const mesh::Surface& surface) {
  if (surface.face_count() == 0) {
    return false;
  }
  FaceId largest(0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    largest = surface.area(f) > surface.area(largest) ? f : largest;
  }
  const Vec3 size = surface.bounds().size();
  const double allowed = std::min(thickness_mm, thickness_share * std::max({size.x, size.y, size.z}));
  const Vec3 normal = surface.normal(largest);
  const double level = dot(normal, surface.point(surface.vertices(largest)[0]));
  const bool flat = std::all_of(surface.points().begin(), surface.points().end(),
                                [&](Vec3 p) { return std::abs(dot(normal, p) - level) <= allowed; });
  if (!flat) {
    return false;
  }
  const auto edges = ids<EdgeId>(surface.edge_count());
  return std::any_of(edges.begin(), edges.end(),
                     [&](EdgeId e) { return std::abs(surface.fold_angle(e)) > 0.5 * std::numbers::pi; });
}

}  // namespace ridgecraft::unfold
