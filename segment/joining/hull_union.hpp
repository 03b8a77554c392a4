// SPDX-License-Identifier: GPL-3.0-or-later
// The volume of the union of hulls that are joined one by one, measured on rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/hull/hull_rays.hpp"

namespace ridgecraft::segment {

/// The stretches of all rays inside the hulls of some groups.
class HullUnion {
 public:
  /// Empties it. Without rays everything is 0, and costs nothing.
  void start(bool with_rays);
  /// `rays`: the stretches inside the group's hull.
  void add(std::uint32_t group, std::span<const RaySpan> rays);
  /// Two groups become one, of number g, with this hull, which holds theirs.
  void unite(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays);

  /// Length of the union on all rays; times volume_per_length() its volume.
  [[nodiscard]] double length() const;
  /// By how much it grows when two groups become one with this hull.
  [[nodiscard]] double added_length(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays) const;

 private:
  struct Slab {
    std::uint32_t group = 0;
    RaySpan span;
  };
  std::vector<std::vector<Slab>> slabs_;  ///< of each ray
};

}  // namespace ridgecraft::segment
