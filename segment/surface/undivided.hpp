// SPDX-License-Identifier: GPL-3.0-or-later
// A surface without the points that do nothing but divide its triangles. Private to segment/.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model/surface.hpp"
#include "segment/parts/segmentation.hpp"

namespace ridgecraft::segment {

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

}  // namespace ridgecraft::segment
