// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a point lies under a hull along its normal: the cap on concavity (specification 4.5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/hull.hpp"
#include "segment/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Depths under one hull at a time, each computed when first asked for.
class HullDepth {
 public:
  explicit HullDepth(const ScaledSurface& surface);
  /// Must be called when the part changes; the hull must stay alive.
  void select(const Hull& hull);
  /// Distance from v along its normal to the hull's boundary; 0 for hull vertices; infinite when v has no
  /// normal or the hull is flat. O(hull) when first asked for a vertex.
  [[nodiscard]] double at(std::uint32_t v);

 private:
  struct Plane {
    Vec3 normal;  ///< zero for a sliver
    double offset = 0.0;
  };

  void find_planes();
  [[nodiscard]] bool continues_neighbor(std::uint32_t t) const;
  [[nodiscard]] double along_normal(std::uint32_t v) const;

  const ScaledSurface* surface_;
  const Hull* hull_ = nullptr;
  bool planes_known_ = false;
  std::uint32_t current_ = 0;
  std::vector<std::uint32_t> mark_;
  std::vector<double> depth_;
  std::vector<Plane> all_;  ///< per triangle of the hull
  std::vector<double> x_;   ///< planes x X + y Y + z Z = offset, unit normals outward
  std::vector<double> y_;
  std::vector<double> z_;
  std::vector<double> offset_;
};

}  // namespace ridgecraft::segment
