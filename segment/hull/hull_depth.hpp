// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a point lies under a hull: along its normal, or at the side of an opening
// (docs/design/segmentation.md, "Cap on depth"); and the planes of the hull that this is measured from.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

// The planes of a hull's triangles, but for slivers (docs/design/segmentation.md, "Bridges").

/// A plane that has the hull behind it.
struct HullPlane {
  Vec3 normal;               ///< unit, outwards
  double offset = 0.0;       ///< of its points along the normal
  std::uint32_t number = 0;  ///< of its triangle
};

/// Whether a triangle with these corners is too thin to say where its plane runs. Hulls of CAD-like meshes
/// have such triangles, with three corners nearly on one edge.
[[nodiscard]] bool is_sliver(Vec3 a, Vec3 b, Vec3 c);

/// Replaces `planes` by those of all triangles that aren't slivers, in order.
void find_hull_planes(const Hull& hull, std::span<const Vec3> points, std::vector<HullPlane>& planes);

// The planes of a hull, sorted by where they face: the near ones are found without a look at all of them.

/// Planes in cells of a cube whose sides are divided into squares, by direction: one cell's face nearly the
/// same way, and what of them is nearest is bounded by one product.
class PlaneDirections {
 public:
  /// Replaces all planes, of a hull round about `centre`: O(n). There are about as many cells as planes in
  /// one.
  void assign(std::span<const HullPlane> planes, Vec3 centre);

  /// The least distance from p (behind all planes or nearly so) to a plane that is at most `limit` away,
  /// whose normal's cosine to n is above `least_cosine`, and of which `counts(plane)` holds, asked only for
  /// planes nearer than all before; infinite when there is none. Typically O(sqrt n).
  template <typename Counts>
  [[nodiscard]] double nearest(Vec3 p, Vec3 n, double limit, double least_cosine, Counts counts) const {
    double nearest = std::numeric_limits<double>::infinity();
    double bound = limit;
    const Vec3 from_centre = p - centre_;
    for (const Cell& cell : cells_) {
      if (cell.least_offset - most(cell, from_centre) > bound + rounding ||
          most(cell, n) <= least_cosine - rounding) {
        continue;
      }
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
        const HullPlane& plane = planes_[i];
        const double distance = plane.offset - dot(plane.normal, p);
        if (distance <= bound && distance < nearest && dot(plane.normal, n) > least_cosine && counts(plane)) {
          nearest = bound = distance;
        }
      }
    }
    return nearest;
  }

 private:
  /// Of sums of three products, on the unit sphere.
  static constexpr double rounding = 1e-12;

  /// The planes planes_[begin] ... planes_[end - 1], at least one.
  struct Cell {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    double least_offset = std::numeric_limits<double>::infinity();  ///< from the centre
    Box3 normals;
  };

  /// The greatest product of v and a vector in the cell's box of normals.
  [[nodiscard]] static double most(const Cell& cell, Vec3 v) {
    const Vec3 low = cell.normals.low;
    const Vec3 high = cell.normals.high;
    return v.x * (v.x > 0.0 ? high.x : low.x) + v.y * (v.y > 0.0 ? high.y : low.y) +
           v.z * (v.z > 0.0 ? high.z : low.z);
  }

  Vec3 centre_;
  std::vector<HullPlane> planes_;  ///< by cell
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> place_;  ///< scratch: cell of each plane
  std::vector<std::uint32_t> first_;  ///< scratch: where each cell begins
};

/// How far an opening may be from a vertex whose depth it limits: whatever the tolerance, so that the
/// concavity of a part is its own.
inline constexpr double opening_scale = 0.1;

/// Depths under one hull at a time, each computed when first asked for.
class HullDepth {
 public:
  /// What select() is given.
  enum class HullIs : std::uint8_t {
    whole,  ///< the part's
    inner   ///< that of some of the part's points: depths are lower bounds of those under the whole hull
  };

  HullDepth(const ScaledSurface& surface, const Context& context);
  /// Must be called when the part changes; the hull must stay alive.
  void select(const Hull& hull, HullIs is = HullIs::whole);
  /// Distance from v, a point in the hull, along its normal to the hull's boundary; 0 for hull vertices;
  /// infinite when v has no normal or the hull is flat.
  ///
  /// Where that is more than `above`, there may be a shorter way out through an opening, as from the inner
  /// side of a vessel's rim, whose normal leads across the whole vessel. A facet of the hull closes an
  /// opening at v if all three hold: its plane is nearer to v than opening_scale; it isn't behind
  /// the surface at v (its normal doesn't point against that of v); and the hull is many times thicker behind
  /// it than that scale, so that the facet lies over a hollow body and isn't the flat side of a thin thing,
  /// in which the gap between two arms stays deep. The depth is then at most the distance to that plane.
  ///
  /// When first asked for a vertex: a walk over the hull from where the last one ended; for those deeper
  /// than `above` a search among the facets, and once for each facet that is near enough a climb over the
  /// hull. Throws Error(interrupted) when the user asked to stop.
  [[nodiscard]] double at(std::uint32_t v, double above);

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
  HullIs is_ = HullIs::whole;
  bool has_planes_ = false;           ///< for this hull: not before they are asked for
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
