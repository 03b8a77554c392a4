// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a point lies under a hull: along its normal or beside an opening (docs/design/segmentation.md,
// "Cap on depth").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/plane_directions.hpp"
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

  /// Depths up to `tolerance` needn't be exact: of those nothing but the way along the normal is looked at.
  /// `opening_scale`: how far an opening may be, mostly the tolerance.
  HullDepth(const ScaledSurface& surface, double tolerance, double opening_scale, const Context& context);
  /// Must be called when the part changes; the hull must stay alive.
  void select(const Hull& hull, HullIs is = HullIs::whole);
  /// Distance from v, a point in the hull, along its normal to the hull's boundary; 0 for hull vertices;
  /// infinite when v has no normal or the hull is flat.
  ///
  /// Where that is above the tolerance, there may be a shorter way out through an opening, as from the inner
  /// side of a vessel's rim, whose normal leads across the whole vessel. A facet of the hull closes an
  /// opening beside v if all three hold: its plane is nearer to v than the scale of openings; it isn't behind
  /// the surface at v (its normal doesn't point against that of v); and the hull is many times thicker behind
  /// it than that scale, so that the facet lies over a hollow body and isn't the flat side of a thin thing,
  /// in which the gap between two arms stays deep. The depth is then at most the distance to that plane.
  ///
  /// When first asked for a vertex: a walk over the hull from where the last one ended; for those above the
  /// tolerance a search among the facets, and once for each facet that is near enough a climb over the hull.
  /// Throws Error(interrupted) when the user asked to stop.
  [[nodiscard]] double at(std::uint32_t v);

 private:
  /// Of the hull along a plane's normal.
  enum class Thickness : std::uint8_t { unknown, thin, thick };

  [[nodiscard]] double along_normal(std::uint32_t v);
  [[nodiscard]] double beside_opening(std::uint32_t v);
  [[nodiscard]] bool is_thick(const HullPlane& plane);
  void find_planes();
  [[nodiscard]] std::optional<std::uint32_t> walk(Vec3 p, Vec3 n);
  [[nodiscard]] double to_plane(std::uint32_t triangle, Vec3 p, Vec3 n) const;
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::size_t side) const;

  const ScaledSurface* surface_;
  const Hull* hull_ = nullptr;
  const Context* context_;
  double tolerance_;
  double opening_scale_;
  HullIs is_ = HullIs::whole;
  bool has_planes_ = false;           ///< for this hull: not while nobody asked
  PlaneDirections planes_;            ///< of the hull's triangles that aren't slivers
  std::vector<Thickness> thickness_;  ///< of each triangle
  std::vector<HullPlane> found_;      ///< scratch
  std::uint32_t far_triangle_ = 0;    ///< with a corner far behind the last plane
  std::size_t far_corner_ = 0;
  std::size_t unchecked_ = 0;  ///< questions since the last one whether to stop
  std::uint32_t current_ = 0;
  std::uint32_t last_ = 0;  ///< triangle at which the last walk ended
  std::vector<std::uint32_t> mark_;
  std::vector<double> depth_;
};

}  // namespace ridgecraft::segment
