// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that run through each other are found. Keeps CGAL out of headers. Private to prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "prepare/skin/facets.hpp"

namespace ridgecraft::prepare {

/// Pairs of triangles, and rays, between two questions whether to stop.
inline constexpr std::size_t pairs_per_check = 1U << 12U;

[[nodiscard]] Box3 box_of(const std::vector<Vec3>& points, const Corners& t);

/// How two triangles with given corners (by place) meet beyond what they share as neighbours.
class Contacts {
 public:
  explicit Contacts(const std::vector<Vec3>& points);

  [[nodiscard]] bool has_area(const Corners& t) const;
  /// Do they share more than a corner or a side? Both have an area.
  [[nodiscard]] bool meet(const Corners& f, const Corners& g) const;

 private:
  [[nodiscard]] bool beside_plane(const Corners& f, const Corners& g) const;
  [[nodiscard]] bool meet_beyond_corner(const Corners& f, const Corners& g) const;
  [[nodiscard]] bool sectors_meet(const Corners& f, const Corners& g) const;

  const std::vector<Vec3>& points_;
  double diagonal_ = 0.0;
};

/// Whether two triangles run through each other; those with a common place for a corner don't count.
[[nodiscard]] bool has_crossings(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                                 const Context& context);

}  // namespace ridgecraft::prepare
