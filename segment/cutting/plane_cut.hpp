// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts by planes, through both skins of a wall at once: what valleys can't find (docs/design/segmentation.md,
// "More effort, smaller hulls, no pockets").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/cutting/cut.hpp"
#include "segment/cutting/minimum_cut.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Plane of points p with dot(normal, p) = offset.
struct CutPlane {
  Vec3 normal;
  double offset = 0.0;
};

class PlaneCutter {
 public:
  PlaneCutter(const ScaledSurface& surface, const EdgeWeights& weights);

  /// Cuts a part so that the hulls of its pieces are together as small as one plane, or two planes across
  /// each other, can make them. Pieces are connected, ascending by smallest facet; a single one when no plane
  /// saves `least` of hull volume per piece. `reach`: how far the border may move from the plane to shorter
  /// or concave edges.
  [[nodiscard]] std::vector<Facets> cut(Cutter& cutter, std::span<const std::uint32_t> facets, double least,
                                        double reach, bool stars);

  /// Volume that the part would enclose if its openings were closed by fans.
  [[nodiscard]] double closed_volume(std::span<const std::uint32_t> facets) const;
  /// Volume of the hull of the facets' corners; hull() is that hull until the next call.
  [[nodiscard]] double hull_volume(std::span<const std::uint32_t> facets);
  [[nodiscard]] const Hull& hull() const { return hull_; }
  [[nodiscard]] std::span<const std::uint32_t> hull_vertices() const { return hull_.vertices; }
  /// Volume of the hull of these vertices.
  [[nodiscard]] double volume_of(std::span<const std::uint32_t> vertices);

 private:
  struct Trial {
    std::vector<CutPlane> planes;
    bool floor = false;  ///< what is below the first plane isn't cut by the others
    double gain = 0.0;   ///< volume saved beyond what the additional pieces are worth
  };

  void take_part(std::span<const std::uint32_t> facets);
  [[nodiscard]] std::vector<Trial> trials(bool stars) const;
  void add_stars(const std::array<Vec3, 3>& axes, std::vector<Trial>& out) const;
  void measure(Trial& trial, double least);
  [[nodiscard]] std::array<double, 2> extent(Vec3 direction) const;
  void label(const CutPlane& plane, double reach, std::uint32_t bit);

  const ScaledSurface* surface_;
  const EdgeWeights* weights_;
  HullBuilder hulls_;
  Hull hull_;
  MaximumFlow flow_;
  std::vector<std::uint32_t> facets_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> sample_;  ///< of the vertices: those that trials measure
  std::vector<std::uint32_t> mark_;
  std::uint32_t current_ = 0;
  std::vector<std::uint32_t> node_;  ///< per facet
  std::vector<std::uint32_t> side_;  ///< per facet
  Vec3 middle_;
  std::array<Vec3, 3> axes_{};         ///< of the surface's spread
  std::array<Vec3, 3> normal_axes_{};  ///< of its normals' spread
  std::array<Vec3, 3> whole_axes_{};   ///< of the part that was last cut by stars
  double volume_ = 0.0;
};

}  // namespace ridgecraft::segment
