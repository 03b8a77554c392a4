// SPDX-License-Identifier: GPL-3.0-or-later
// Flat openings of a surface: what stands on something, or is closed by it.
#pragma once

#include <array>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// What is no farther apart than this touches: paper is about as thick.
inline constexpr double touching_mm = 0.2;

/// A closed border that lies in a plane.
struct Opening {
  std::vector<CornerId> sides;  ///< as they follow each other, each with the face beside it
  Vec3 middle;                  ///< of the sides' ends
  Vec3 normal;                  ///< of a face that would close it; it looks out of the surface
};

/// Openings whose ends of sides are no farther from their common plane than `flat_mm`, in the order of their
/// first sides. O(n) for n corners.
[[nodiscard]] std::vector<Opening> flat_openings(const Surface& surface, double flat_mm);

/// Whether the face beside a side of an opening rises from its plane by 30 degrees and more: what has such
/// sides stands on what lies below; the others are those of a hole in a flat face, or of a sheet.
[[nodiscard]] bool rises_at(const Surface& surface, const Opening& opening, CornerId side);

/// Triangles that close an opening: from its middle to each side, in their order, where the middle sees all
/// of it, else any. None where its border crosses itself. O(n log n) for n sides.
[[nodiscard]] std::vector<std::array<Vec3, 3>> triangles_of(const Surface& surface, const Opening& opening);

}  // namespace ridgecraft::mesh
