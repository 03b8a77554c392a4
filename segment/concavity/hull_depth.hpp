// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a point lies under a hull: along its normal (specification 4.5) or beside an opening. The cap on
// concavity.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segment/concavity/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Depths under one hull at a time, each computed when first asked for.
class HullDepth {
 public:
  /// What select() is given.
  enum class HullIs : std::uint8_t {
    whole,  ///< the part's
    inner   ///< that of some of the part's points: depths are lower bounds of those under the whole hull
  };

  HullDepth(const ScaledSurface& surface, double tolerance);
  /// Must be called when the part changes; the hull must stay alive.
  void select(const Hull& hull, HullIs is = HullIs::whole);
  /// Distance from v, a point in the hull, along its normal to the hull's boundary; 0 for hull vertices;
  /// infinite when v has no normal or the hull is flat.
  ///
  /// Where that is above the tolerance: at most the distance to the plane of a hull facet that lies within
  /// the tolerance, doesn't lie behind the surface and closes an opening: the hull is many times as thick
  /// there as the tolerance. So the rim of a vessel isn't deep, though the way along the normal leads across
  /// all of it; where the gap between two arms of a flat thing meets its flat side, it is.
  ///
  /// When first asked for a vertex: a walk over the hull from where the last one ended, and for those above
  /// the tolerance a pass over all facets.
  [[nodiscard]] double at(std::uint32_t v);

 private:
  struct Plane {
    Vec3 normal;              ///< unit; zero for a triangle too thin to have one
    double offset = 0.0;      ///< of its points along the normal
    double thickness = -1.0;  ///< of the hull along the normal; negative: not yet known
  };

  [[nodiscard]] double along_normal(std::uint32_t v);
  [[nodiscard]] double beside_opening(std::uint32_t v);
  [[nodiscard]] double thickness(Plane& plane) const;
  void find_planes();
  [[nodiscard]] std::optional<std::uint32_t> walk(Vec3 p, Vec3 n);
  [[nodiscard]] double to_plane(std::uint32_t triangle, Vec3 p, Vec3 n) const;
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::size_t side) const;

  const ScaledSurface* surface_;
  const Hull* hull_ = nullptr;
  double tolerance_;
  HullIs is_ = HullIs::whole;
  std::vector<Plane> planes_;  ///< of the hull's triangles; empty while nobody asked
  std::uint32_t current_ = 0;
  std::uint32_t last_ = 0;  ///< triangle at which the last walk ended
  std::vector<std::uint32_t> mark_;
  std::vector<double> depth_;
};

}  // namespace ridgecraft::segment
