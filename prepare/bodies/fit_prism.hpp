// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest prism around a body, and how much of it the body covers. Private to prepare/.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// How much a body covers of what a larger one covers that encloses it, both seen along a unit vector: from 0
/// to 1. What is seen through a hole of the body counts as covered. On a grid of 48 by 48 cells, so to about
/// 2 %. O(faces * cells).
[[nodiscard]] double silhouette_fraction(const mesh::Surface& body, const mesh::Surface& larger,
                                         Vec3 direction);

struct Prism {
  std::vector<Vec3> base;  ///< counterclockwise seen from the top
  Vec3 along;              ///< from the base to the top, at right angles to both

  [[nodiscard]] double volume() const;
};

/// Lengths in the unit of the points.
struct PrismRules {
  double short_side = 0.0;  ///< sides of the base are made longer as long as that is possible
  double shallow = 0.0;     ///< lower ones are plates
  std::size_t most_sides = 8;
};

/// The smallest prism around the points, along one of the unit vectors `directions`, whose base is their
/// outline with the sides left out that are short: those beside them go on until they meet, so that planes of
/// the outline stay planes, and a mirror image of itself stays one. None where the points don't reach nearly
/// as far at both ends, as those of a cone, or where all would be shallow. O(n log n + s^2) a direction for n
/// points, s of them on the outline.
[[nodiscard]] std::optional<Prism> fit_prism(std::span<const Vec3> points, std::span<const Vec3> directions,
                                             const PrismRules& rules);

}  // namespace ridgecraft::prepare
