// SPDX-License-Identifier: GPL-3.0-or-later
// Points that only divide triangles: they are taken out before a segmentation, and put back after it.
// Private to segment/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model/surface.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

// A surface without the points that do nothing but divide its triangles. Private to segment/.

/// The surface that one was made from by dividing its triangles; empty where there is none.
struct Undivided {
  mesh::Surface surface;
  std::vector<std::uint32_t> polygon;  ///< of each face, as in segment(): what was one polygon stays together
  std::vector<std::uint32_t> label;    ///< of each face, where the given ones have labels
  std::vector<FaceId> face_of;         ///< of each given face: the one that it is a piece of
  std::vector<VertexId> vertex_of;     ///< of each vertex: its number in the given surface, ascending

  [[nodiscard]] bool any() const { return !face_of.empty(); }
  /// The part with the faces and vertices of the given surface.
  void to_given_numbers(Part& part) const;
};

/// Concavity is measured at vertices, and what is divided has more of them: it would be a little more
/// concave, and be cut where the other has no edges. So a component comes back whose faces all are flat
/// triangles of several faces, within 1e-6 of the surface's diagonal, with straight sides along edges of the
/// given one and corners where the surface bends, at least along two directions. Components that aren't
/// divided in this way stay as they are; labels are the same in one triangle. O(n log n).
[[nodiscard]] Undivided undivide(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                 std::span<const std::uint32_t> label);

// Points inside of valleys that run from one rim to another. Private to segment/.

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
