// SPDX-License-Identifier: GPL-3.0-or-later
// How deep a point lies under a hull along its normal: the cap on concavity (specification 4.5).
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
  explicit HullDepth(const ScaledSurface& surface);
  /// Must be called when the part changes; the hull must stay alive.
  void select(const Hull& hull);
  /// Distance from v, a point in the hull, along its normal to the hull's boundary; 0 for hull vertices;
  /// infinite when v has no normal or the hull is flat. When first asked for a vertex: a walk over the hull
  /// from where the last one ended.
  [[nodiscard]] double at(std::uint32_t v);

 private:
  [[nodiscard]] double along_normal(std::uint32_t v);
  [[nodiscard]] std::optional<std::uint32_t> walk(Vec3 p, Vec3 n);
  [[nodiscard]] double to_plane(std::uint32_t triangle, Vec3 p, Vec3 n) const;
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::size_t side) const;

  const ScaledSurface* surface_;
  const Hull* hull_ = nullptr;
  std::uint32_t current_ = 0;
  std::uint32_t last_ = 0;  ///< triangle at which the last walk ended
  std::vector<std::uint32_t> mark_;
  std::vector<double> depth_;
};

}  // namespace ridgecraft::segment
