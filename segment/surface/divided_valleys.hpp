// SPDX-License-Identifier: GPL-3.0-or-later
// Points inside of valleys that run from one rim to another. Private to segment/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model/surface.hpp"
#include "segment/parts/segmentation.hpp"

namespace ridgecraft::segment {

/// Valleys are divided above this share of the tolerance.
inline constexpr double shortest_valley_share = 0.1;

/// A surface whose lonely valleys have points inside; empty where there are none.
struct DividedValleys {
  mesh::Surface surface;
  std::vector<std::uint32_t> polygon;  ///< of each face, as in segment(): what was one face stays together
  std::vector<FaceId> face_of;         ///< the face that each is a piece of, ascending
  std::size_t given_vertices = 0;      ///< all others lie on edges of the given ones

  [[nodiscard]] bool any() const { return !face_of.empty(); }
  /// The part of the surface that was given: faces once, hull vertices without those added.
  void to_given_numbers(Part& part) const;
};

/// Concavity is measured at vertices, and both ends of a valley that crosses a prism lie on the rims of its
/// flat sides: on the hull, however deep the notch is between them. So concave edges (5 degrees and more)
/// that no other one continues at either end are halved, those that are longer than `shortest` in the scale
/// of the enclosing ball. O(n).
[[nodiscard]] DividedValleys divide_valleys(const mesh::Surface& surface,
                                            std::span<const std::uint32_t> polygon, double shortest);

}  // namespace ridgecraft::segment
